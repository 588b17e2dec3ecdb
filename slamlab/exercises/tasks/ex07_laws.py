"""What the tasks of exercise 07 share: covariances, exact samples, how a mistake is recognised."""

import numpy as np

from slamlab.exercises.law import Diagnosis

TOLERANCE = 1e-6
"""Share of a matrix's largest entry: rounding passes, no mistake does."""


def covariances(rng, sigmas, surplus=3):
    """Covariances with given standard deviations and correlations of every size.

    Parameters
    ----------
    rng : numpy.random.Generator
    sigmas : (n, k)
    surplus : int, the less, the stronger the correlations

    Returns
    -------
    (n, k, k)
    """
    n, k = sigmas.shape
    roots = rng.standard_normal((n, k, k + surplus))
    roots *= (sigmas / np.linalg.norm(roots, axis=2))[:, :, None]
    return roots @ T(roots)


def T(M):
    """The transpose of each matrix of a stack."""
    return np.swapaxes(M, -1, -2)


def white(rng, pairs, k):
    """Samples with mean 0 and covariance 1, both exact: mirrored, then scaled."""
    half = rng.standard_normal((pairs, k))
    half = half @ np.linalg.inv(np.linalg.cholesky(half.T @ half / pairs)).T
    return np.vstack([half, -half])


def samples(P):
    """Samples whose covariance is P, with nothing left to chance.

    Parameters
    ----------
    P : (n, k, k) positive definite

    Returns
    -------
    (n, samples, k)
    """
    return WHITE[:, : P.shape[-1]] @ T(np.linalg.cholesky(P))


def spread(errors):
    """Mean square E[e eᵀ] of samples (..., samples, k) about zero, (..., k, k)."""
    return T(errors) @ errors / errors.shape[-2]


def close(got, want, tolerance=TOLERANCE):
    """Whether arrays agree, for each input.

    Parameters
    ----------
    got, want : (n, ...)
    tolerance : float, share of the largest entry

    Returns
    -------
    (n,) bool
    """
    error, size = (np.abs(a).reshape(len(got), -1).max(axis=1) for a in (got - want, want))
    return error <= tolerance * size


def mistake(name, hint, *wrong, output="result", rows=np.s_[:]):
    """A diagnosis: an output equals one of the wrong formulas.

    Parameters
    ----------
    name, hint : str
    wrong : inputs -> (n, ...), each a form the mistake takes
    output : str, the output looked at
    rows : index, of what it looks at in the output

    Returns
    -------
    Diagnosis
    """

    def matches(inputs, outputs):
        got = outputs[output][rows]
        return any(close(got, formula(inputs)).all() for formula in wrong)

    return Diagnosis(name, hint, matches)


WHITE = white(np.random.default_rng(7), 32, 9)
"""The same for everyone: whatever is linear in them is met up to rounding."""
