"""Stacks of beliefs for exercise 05: one row each, so that a judge computes all rows at once."""

import numpy as np

from slamlab import models
from slamlab.geometry import wrap
from slamlab.models import jacobians

SHARE = 1e-3
"""Of a standard deviation: differences for Jacobians pass, no classic mistake does."""


def covariances(rng, sigmas):
    """Covariances (n, k, k) with these standard deviations (n, k) and correlations of all sizes."""
    n, k = sigmas.shape
    roots = rng.standard_normal((n, k, 2 * k))
    P = roots @ turned(roots)
    unit = sigmas / np.sqrt(np.diagonal(P, axis1=1, axis2=2))
    return P * unit[:, :, None] * unit[:, None, :]


def variances(sigmas):
    """Diagonal matrices (n, k, k) of squared standard deviations (n, k)."""
    return sigmas[:, :, None] ** 2 * np.eye(sigmas.shape[1])


def turned(M):
    """The transpose of each matrix of a stack."""
    return np.swapaxes(M, -1, -2)


def times(M, v):
    """Each matrix times its vector."""
    return np.einsum("nij,nj->ni", M, v)


def sandwich(J, C):
    """J C Jᵀ of each row."""
    return J @ C @ turned(J)


def deviations(P):
    """Standard deviations (..., k) of covariances (..., k, k); a mistake's P may be negative."""
    return np.sqrt(np.abs(np.diagonal(P, axis1=-2, axis2=-1)))


def each(function, *stacks):
    """The function of each row, stacked."""
    return np.array([function(*row) for row in zip(*stacks, strict=True)])


def innovation(x, p, z, wrapped=True):
    """z − h(x, p) of each row, the bearing wrapped or not."""
    v = z - each(models.h, x, p)
    if wrapped:
        v[:, 1] = wrap(v[:, 1])
    return v


def gain(P, H, R):
    """K and S of each row."""
    S = sandwich(H, P) + R
    return P @ turned(H) @ np.linalg.inv(S), S


def placed(x, z, R):
    """A landmark first seen from a pose: p (n, 2), P (n, 2, 2)."""
    return each(models.g, x, z), sandwich(each(jacobians.J_z, x, z), R)


def off_pose(got, want):
    """Differences of poses (..., 3), headings wrapped."""
    off = got - want
    off[..., 2] = wrap(off[..., 2])
    return off


def same_mean(got, want, sigma, heading=False):
    """(n,) whether means agree to a share of the standard deviations."""
    off = off_pose(got, want) if heading else got - want
    return (np.abs(off) <= SHARE * sigma).all(axis=-1)


def same_covariance(got, want, share=SHARE):
    """(...) whether covariances agree to a share of the standard deviations."""
    sigma = deviations(want)
    scale = sigma[..., :, None] * sigma[..., None, :]
    return (np.abs(got - want) <= share * scale).all(axis=(-1, -2))
