"""Random beliefs and measurements, judged by samples and least squares, not by the filter's
formulas."""
# No matrix is symmetric or diagonal that need not be, so that a transposition cannot hide.

import numpy as np

ROWS = 8
STATES, MEASURED = 3, 2  # of the random inputs; probes have sizes of their own


def either_sign(rng, low, high, shape):
    """Numbers of magnitude between low and high."""
    return rng.choice([-1.0, 1.0], shape) * rng.uniform(low, high, shape)


def covariances(rng, rows, size, low=0.4, high=1.6):
    """(rows, size, size) with standard deviations between low and high."""
    roots = rng.standard_normal((rows, size, size + 2))
    P = roots @ turned(roots)
    scale = rng.uniform(low, high, (rows, size)) / np.sqrt(np.diagonal(P, axis1=1, axis2=2))
    return P * scale[:, :, None] * scale[:, None, :]


def noises(rng, rows, size):
    """Noise covariances Q or R, (rows, size, size)."""
    # below 1, so that squares and roots differ
    sigma, together = rng.uniform(0.3, 0.75, (rows, size)), rng.uniform(0.2, 0.6, (rows, 1, 1))
    correlation = together + (1 - together) * np.eye(size)
    return correlation * sigma[:, :, None] * sigma[:, None, :]


def motions(rng, rows, size):
    """(rows, size, size) F without special structure, of norm 1.05."""
    F = np.eye(size) + rng.uniform(-0.8, 0.8, (rows, size, size))
    return F * (1.05 / np.linalg.norm(F, 2, axis=(1, 2)))[:, None, None]


def sensors(rng, rows, measured, states):
    """(rows, measured, states) H with linearly independent rows."""
    H = rng.uniform(-0.6, 0.6, (rows, measured, states))
    for k in range(measured):
        H[:, k, (2 * k) % states] += (-1) ** k
    return H


def before_measurement(rng, states=STATES, measured=MEASURED, rows=ROWS, precision=1.0):
    """Priors x (rows, n), P and measurements z (rows, m), H, R; ``precision`` divides the sensor's
    standard deviations."""
    x = either_sign(rng, 0.5, 4, (rows, states))
    P, H = covariances(rng, rows, states), sensors(rng, rows, measured, states)
    off = either_sign(rng, 0.4, 1.5, (rows, measured))
    R = noises(rng, rows, measured) / precision**2
    return {"x": x, "P": P, "z": times(H, x) + off, "H": H, "R": R}


SIZES = {
    "one state and one measured number": (1, 1),
    "two states and one measured number": (2, 1),
    "four states and three measured numbers": (4, 3),
    "more measured numbers than states": (2, 4),
}
"""Sizes of probes: each name maps to the numbers of states and of measured numbers."""


def turned(M):
    return np.swapaxes(M, -1, -2)


def times(M, v):
    """Stack of matrices times stack of vectors."""
    return np.einsum("...ij,...j->...i", M, v)


def samples(*covariances):
    """Zero-mean errors (rows, points, k) with exactly these covariances, mutually uncorrelated."""
    total = sum(c.shape[-1] for c in covariances)
    points, drawn, first = np.sqrt(total) * np.vstack([np.eye(total), -np.eye(total)]), [], 0
    for c in covariances:
        last = first + c.shape[-1]
        drawn.append(points[:, first:last] @ turned(np.linalg.cholesky(c)))
        first = last
    return drawn


def whitener(covariance):
    """W with W P Wᵀ = I."""
    return np.linalg.inv(np.linalg.cholesky(covariance))


def least_squares(i):
    """Maximum a posteriori estimate and its covariance, per row."""
    prior, seen = whitener(i["P"]), whitener(i["R"])
    A = np.concatenate([prior, seen @ i["H"]], axis=1)
    y = np.concatenate([times(prior, i["x"]), times(seen, i["z"])], axis=1)
    P = np.linalg.inv(turned(A) @ A)
    return times(P @ turned(A), y), P
