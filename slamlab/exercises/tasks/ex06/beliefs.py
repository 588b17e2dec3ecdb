"""Beliefs for exercise 06, and what becomes of them by their own errors.

The law of moments: carry errors of a belief, a pair for each direction of its covariance, through
the model itself; the covariance of what comes out is P. No Jacobian is consulted.
"""

import numpy as np

from slamlab.geometry import wrap

SMALL = 1e-4  # the errors carried, as a share of the belief's: there every model is straight


def either_sign(rng, low, high, size=None):
    """Numbers whose magnitude lies between low and high."""
    return rng.choice([-1.0, 1.0], size) * rng.uniform(low, high, size)


def covariances(rng, sigma):
    """(k, n, n) random covariances with standard deviations (k, n), nothing uncorrelated."""
    k, n = sigma.shape
    roots = rng.standard_normal((k, n, n + 2))
    P = roots @ roots.transpose(0, 2, 1)
    scale = sigma / np.sqrt(np.diagonal(P, axis1=1, axis2=2))
    return P * scale[:, :, None] * scale[:, None, :]


def beliefs(rng, count, landmarks):
    """States of a robot and landmarks around it, with all that their errors share.

    Returns
    -------
    x (count, 3 + 2 landmarks), P (count, same, same)
    """
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
    """Mean and covariance of f(state, other), both in error, by errors carried through f.

    Parameters
    ----------
    f : (states (n, m), others (c, m)) -> (k, m), a column each; row 2 of the result is an angle
    x : ((n,), (c,)) the means;  P : (n, n);  C : (c, c)

    Returns
    -------
    (k,), (k, k)
    """
    (state, other), n = x, len(P)
    root = np.zeros((n + len(C), n + len(C)))
    root[:n, :n], root[n:, n:] = square_root(P), square_root(C)
    errors = SMALL * np.sqrt(len(root)) * np.hstack([root, -root])
    mean = f(state[:, None], other[:, None])[:, 0]
    off = f(state[:, None] + errors[:n], other[:, None] + errors[n:]) - mean[:, None]
    off[2] = wrap(off[2])
    return mean, off @ off.T / (2 * len(root)) / SMALL**2


def square_root(P):
    """(n, n) B with B Bᵀ = P, where P may be singular."""
    variances, directions = np.linalg.eigh(P)
    return directions * np.sqrt(np.maximum(variances, 0))


def T(M):
    """The transpose of each matrix of a stack."""
    return np.swapaxes(M, -1, -2)
