"""Beliefs for exercise 06, propagated through a model by sigma points without Jacobians."""

import numpy as np

from slamlab.geometry import wrap

SMALL = 1e-4  # scale of the propagated errors: so small that every model is linear


def either_sign(rng, low, high, size=None):
    """Numbers of magnitude between low and high."""
    return rng.choice([-1.0, 1.0], size) * rng.uniform(low, high, size)


def covariances(rng, sigma):
    """Full covariances (k, n, n) with standard deviations (k, n)."""
    k, n = sigma.shape
    roots = rng.standard_normal((k, n, n + 2))
    P = roots @ roots.transpose(0, 2, 1)
    scale = sigma / np.sqrt(np.diagonal(P, axis1=1, axis2=2))
    return P * scale[:, :, None] * scale[:, None, :]


def beliefs(rng, count, landmarks):
    """Joint states x (count, 3 + 2 landmarks) and covariances P."""
    poses = np.column_stack(
        [either_sign(rng, 0.5, 4, (count, 2)), either_sign(rng, 0.3, 2.8, count)]
    )
    away = rng.uniform(-np.pi, np.pi, (count, landmarks))
    offset = rng.uniform(1.5, 6, (count, landmarks, 1)) * np.stack([np.cos(away), np.sin(away)], -1)
    x = np.hstack([poses, (poses[:, None, :2] + offset).reshape(count, -1)])
    sigma = rng.uniform(0.05, 0.15, x.shape)
    sigma[:, 2] = rng.uniform(0.03, 0.06, count)
    return x, covariances(rng, sigma)


def moments(f, x, P, C):
    """Mean (k,) and covariance (k, k) of f(state, other), by symmetric pairs of errors. f maps
    columns (n, m), (c, m) to (k, m), row 2 an angle."""
    (state, other), n = x, len(P)
    root = np.zeros((n + len(C), n + len(C)))
    root[:n, :n], root[n:, n:] = square_root(P), square_root(C)
    errors = SMALL * np.sqrt(len(root)) * np.hstack([root, -root])
    mean = f(state[:, None], other[:, None])[:, 0]
    off = f(state[:, None] + errors[:n], other[:, None] + errors[n:]) - mean[:, None]
    off[2] = wrap(off[2])
    return mean, off @ off.T / (2 * len(root)) / SMALL**2


def square_root(P):
    """B (n, n) with B Bᵀ = P; P may be singular."""
    variances, directions = np.linalg.eigh(P)
    return directions * np.sqrt(np.maximum(variances, 0))


def T(M):
    return np.swapaxes(M, -1, -2)
