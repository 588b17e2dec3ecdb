"""Stacks of lines (ρ, α) and their covariances."""

import numpy as np

from slamlab.geometry import wrap


def direction(alpha):
    """Unit vectors (..., 2) at angles alpha."""
    return np.stack([np.cos(alpha), np.sin(alpha)], axis=-1)


def across(direction):
    """Directions turned left by a quarter turn."""
    return direction[..., ::-1] * [-1, 1]


def scatter(points):
    """(n, 2, 2) sums of squares and products about the centroid of points (n, k, 2)."""
    off = points - points.mean(axis=1, keepdims=True)
    return np.einsum("nki,nkj->nij", off, off)


def total(points):
    """Total least squares lines (n, 2), ρ ≥ 0."""
    S = scatter(points)
    alpha = 0.5 * np.arctan2(-2 * S[:, 0, 1], S[:, 1, 1] - S[:, 0, 0])
    rho = np.einsum("ni,ni->n", points.mean(axis=1), direction(alpha))
    return np.column_stack([np.abs(rho), wrap(alpha + np.pi * (rho < 0))])


def covariances(rng, shape, rho, alpha, tie=(0.4, 0.8)):
    """(*shape, 2, 2) of ρ and α; (low, high) of standard deviations [m], [rad] and of
    |correlation|."""
    sigma = np.stack([rng.uniform(*rho, shape), rng.uniform(*alpha, shape)], axis=-1)
    R = sigma[..., :, None] * sigma[..., None, :]
    tied = rng.choice([-1.0, 1.0], shape) * rng.uniform(*tie, shape)
    R[..., 0, 1] *= tied
    R[..., 1, 0] *= tied
    return R
