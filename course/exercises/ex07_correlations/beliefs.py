"""Functions for all tasks of exercise 07: covariances and expected NEES."""

import numpy as np

EXACT = 1e-7
"""Tolerance relative to the largest number: rounding errors are about 1e-12, mistakes are far
larger."""


def T(M):
    return np.swapaxes(M, -1, -2)


def covariances(rng, sigmas, surplus=3):
    """Covariances (n, k, k); the smaller ``surplus``, the stronger the correlations."""
    n, k = sigmas.shape
    roots = rng.standard_normal((n, k, k + surplus))
    roots *= (sigmas / np.linalg.norm(roots, axis=2))[:, :, None]
    return roots @ T(roots)


def expected_nees(x, P, best, P_best):
    """NEES (runs,) averaged over truths t ~ N(best, P_best); n for the best estimate, infinite
    where P is no covariance."""
    # E[(x − t)ᵀ P⁻¹ (x − t)] = (x − best)ᵀ P⁻¹ (x − best) + tr(P⁻¹ P_best)
    off = x - best
    spread = P_best + off[:, :, None] * off[:, None, :]
    definite = np.linalg.eigvalsh((P + T(P)) / 2).min(axis=1) > 0
    P = np.where(definite[:, None, None], P, np.eye(P.shape[1]))
    nees = np.trace(np.linalg.solve(P, spread), axis1=1, axis2=2)
    return np.where(definite, nees, np.inf)
