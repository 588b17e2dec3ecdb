"""Common functions of exercise 04: random inputs."""

import numpy as np


def poses(rng, n):
    return np.column_stack([rng.uniform(-5, 5, (n, 2)), rng.uniform(-np.pi, np.pi, n)])


def polar(rng, n, near=1.2, far=8.0):
    """Random ranges and bearings, (n, 2)."""
    return np.column_stack([rng.uniform(near, far, n), rng.uniform(-np.pi, np.pi, n)])


def covariances(rng, sigmas):
    """Random full covariances (n, k, k) with standard deviations (n, k)."""
    # twice as many random vectors as numbers keep them well away from singular
    n, k = np.shape(sigmas)
    roots = rng.standard_normal((n, k, 2 * k))
    P = roots @ roots.swapaxes(1, 2)
    scale = sigmas / np.sqrt(np.diagonal(P, axis1=1, axis2=2))
    return P * scale[:, :, None] * scale[:, None, :]


def diagonal(sigmas):
    """Covariances (n, k, k) of independent errors."""
    sigmas = np.asarray(sigmas, dtype=float)
    return sigmas[:, :, None] ** 2 * np.eye(sigmas.shape[1])
