"""What the tasks of exercise 07 share: covariances, and NEES over all that may be true."""

import numpy as np

EXACT = 1e-7
"""Share of the largest number wanted: rounding is some 1e-12 of it here, mistakes are far
larger."""


def T(M):
    """The transpose of each matrix of a stack."""
    return np.swapaxes(M, -1, -2)


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


def expected_nees(x, P, best, P_best):
    """NEES of an estimate on average over all that may be true.

    Given what was measured, the truth is spread round the best estimate with that one's
    covariance. So nobody needs to know the truth to judge a claim, nor is there any chance in it:
    E[(x − t)ᵀ P⁻¹ (x − t)] = (x − best)ᵀ P⁻¹ (x − best) + tr(P⁻¹ P_best).

    Parameters
    ----------
    x, P : (runs, n), (runs, n, n), the estimate and its claim
    best, P_best : the same of the best estimate there is

    Returns
    -------
    (runs,); n for the best estimate itself; infinite where a P is no covariance
    """
    off = x - best
    spread = P_best + off[:, :, None] * off[:, None, :]
    definite = np.linalg.eigvalsh((P + T(P)) / 2).min(axis=1) > 0
    P = np.where(definite[:, None, None], P, np.eye(P.shape[1]))
    nees = np.trace(np.linalg.solve(P, spread), axis1=1, axis2=2)
    return np.where(definite, nees, np.inf)
