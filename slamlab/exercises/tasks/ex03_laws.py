"""Laws of exercise 03: moments of samples, least squares; how its mistakes are recognised.

No law knows the filter's formulas. Beliefs have three states, measurements two numbers, and no
matrix is symmetric or diagonal that need not be, so that a transposition cannot hide.
"""

import numpy as np

from slamlab.exercises.law import Diagnosis

ROWS, STATES, MEASURED = 12, 3, 2
TOLERANCE = 1e-6
"""Share of an array's largest entry: rounding is far below, no mistake is."""


DEVIATION = (
    "holds variances already, in squared units: add it as it is, without a square or a root."
)


def covariances(rng, size, low, high, rows=ROWS):
    """Covariances (rows, size, size) with standard deviations between low and high."""
    roots = rng.standard_normal((rows, size, size + 2))
    P = roots @ turned(roots)
    scale = rng.uniform(low, high, (rows, size)) / np.sqrt(np.diagonal(P, axis1=1, axis2=2))
    return P * scale[:, :, None] * scale[:, None, :]


def noises(rng, size, rows=ROWS):
    """Q or R (rows, size, size): below 1, so that squares and roots differ, and no root of -1."""
    sigma, together = rng.uniform(0.3, 0.75, (rows, size)), rng.uniform(0.2, 0.6, (rows, 1, 1))
    correlation = together + (1 - together) * np.eye(size)
    return correlation * sigma[:, :, None] * sigma[:, None, :]


def beliefs(rng):
    """x (rows, 3) and P (rows, 3, 3)."""
    x = rng.choice([-1.0, 1.0], (ROWS, STATES)) * rng.uniform(0.5, 4, (ROWS, STATES))
    return {"x": x, "P": covariances(rng, STATES, 0.4, 1.6)}


def motions(rng, rows=ROWS):
    """F (rows, 3, 3) with nothing special about it."""
    return np.eye(STATES) + rng.uniform(-0.8, 0.8, (rows, STATES, STATES))


def sensors(rng, rows=ROWS):
    """H (rows, 2, 3) whose two rows differ well."""
    H = rng.uniform(-0.6, 0.6, (rows, MEASURED, STATES))
    H[:, 0, 0] += 1
    H[:, 1, 2] -= 1
    return H


def before_measurement(rng):
    """Beliefs, and measurements a little off what they make expect."""
    believed, H = beliefs(rng), sensors(rng)
    off = rng.choice([-1.0, 1.0], (ROWS, MEASURED)) * rng.uniform(0.4, 1.5, (ROWS, MEASURED))
    return {
        **believed,
        "z": times(H, believed["x"]) + off,
        "H": H,
        "R": noises(rng, MEASURED),
    }


def turned(M):
    """The transpose of each matrix of a stack."""
    return np.swapaxes(M, -1, -2)


def samples(*covariances):
    """Errors of mean zero with exactly these covariances, unrelated to each other.

    Parameters
    ----------
    covariances : (rows, k, k) each

    Returns
    -------
    list of (rows, points, k)
    """
    total = sum(c.shape[-1] for c in covariances)
    points, drawn, first = np.sqrt(total) * np.vstack([np.eye(total), -np.eye(total)]), [], 0
    for c in covariances:
        last = first + c.shape[-1]
        drawn.append(points[:, first:last] @ turned(np.linalg.cholesky(c)))
        first = last
    return drawn


def moments(values):
    """Mean (rows, k) and covariance (rows, k, k) of samples (rows, points, k)."""
    mean = values.mean(axis=1)
    off = values - mean[:, None]
    return mean, turned(off) @ off / values.shape[1]


def whitener(covariance):
    """The matrix that turns an error of that covariance into one of covariance 1."""
    return np.linalg.inv(np.linalg.cholesky(covariance))


def least_squares(i):
    """The state that belief and measurement together favour, and its covariance, per row."""
    prior, seen = whitener(i["P"]), whitener(i["R"])
    A = np.concatenate([prior, seen @ i["H"]], axis=1)
    y = np.concatenate([times(prior, i["x"]), times(seen, i["z"])], axis=1)
    solved = (np.linalg.lstsq(a, b, rcond=None)[0] for a, b in zip(A, y, strict=True))
    return np.array(list(solved)), np.linalg.inv(turned(A) @ A)


def times(M, v):
    """A stack of matrices times a stack of vectors."""
    return np.einsum("...ij,...j->...i", M, v)


def close(got, want):
    """Whether arrays agree, for each row."""
    want = np.broadcast_to(want, got.shape)
    error, size = (np.abs(a).reshape(len(got), -1).max(axis=1) for a in (got - want, want))
    return error <= TOLERANCE * np.maximum(size, TOLERANCE)


def mistake(name, hint, output, *wrong):
    """A diagnosis: an output equals, in every row, what one of the wrong formulas gives.

    Parameters
    ----------
    name, hint : str
    output : str, the output looked at
    wrong : inputs -> (rows, ...), each a form the mistake takes

    Returns
    -------
    Diagnosis
    """

    def matches(inputs, outputs):
        return any(_equal(outputs[output], formula(inputs)) for formula in wrong)

    return Diagnosis(name, hint, matches)


def misread(name, rest):
    """Formulas in which a covariance was taken for standard deviations, or the other way round.

    Parameters
    ----------
    name : str, of the covariance among the inputs
    rest : (inputs, covariance misread) -> (rows, ...)

    Returns
    -------
    list of inputs -> (rows, ...)
    """
    wrong = (lambda C: C @ C, lambda C: C**2, np.sqrt)
    return [lambda i, change=change: rest(i, change(i[name])) for change in wrong]


def _equal(got, want):
    return got.shape == np.shape(want) and close(got, want).all()
