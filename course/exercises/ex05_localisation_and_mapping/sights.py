"""Beliefs, measurements and runs for exercise 05, and the reference filter."""

import numpy as np

from slamlab import models
from slamlab.geometry import wrap
from slamlab.models import jacobians


def T(M):
    return np.swapaxes(M, -1, -2)


def either_sign(rng, low, high, size=None):
    """Numbers of magnitude between low and high."""
    return rng.choice([-1.0, 1.0], size) * rng.uniform(low, high, size)


def covariances(rng, sigmas):
    """Covariances (n, k, k) with standard deviations (n, k) and correlations of all sizes."""
    n, k = np.shape(sigmas)
    roots = rng.standard_normal((n, k, k + 2))
    P = roots @ T(roots)
    unit = sigmas / np.sqrt(np.diagonal(P, axis1=1, axis2=2))
    return P * unit[:, :, None] * unit[:, None, :]


def beliefs(rng, rows):
    """Poses (rows, 3) and their covariances."""
    x = np.column_stack([either_sign(rng, 0.5, 5, (rows, 2)), either_sign(rng, 0.3, 2.8, rows)])
    sigmas = np.column_stack([rng.uniform(0.08, 0.2, (rows, 2)), rng.uniform(0.04, 0.1, rows)])
    return x, covariances(rng, sigmas)


def each(function, *stacks):
    """The function of each row, stacked."""
    return np.array([function(*row) for row in zip(*stacks, strict=True)])


def driven(x, drives):
    """The poses (n, 3) after each of the drives (n, 2)."""
    poses = []
    for u in drives:
        x = models.f_odometry(x, u)
        poses.append(x)
    return np.array(poses)


def filtered(x, P, drives, ids, zs, landmarks, C, R):
    """The filter's beliefs after every step of one run: xs (n, 3), Ps (n, 3, 3)."""
    xs, Ps = [], []
    for u, id, z in zip(drives, ids.astype(int), zs, strict=True):
        A, W = jacobians.A_odometry(x, u), jacobians.W_odometry(x, u)
        x, P = models.f_odometry(x, u), A @ P @ A.T + W @ C @ W.T
        if id >= 0:
            H = jacobians.H_robot(x, landmarks[id])
            v = z - models.h(x, landmarks[id])
            v[1] = wrap(v[1])
            S = H @ P @ H.T + R
            K = np.linalg.solve(S, H @ P).T
            x, P = x + K @ v, P - K @ S @ K.T
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)


def with_wrapped_heading(name):
    """Parts of outputs: poses of this name with headings in (−π, π]."""

    def parts(inputs, outputs):
        x = outputs[name].copy()
        x[..., 2] = wrap(x[..., 2])
        return {**outputs, name: x}

    return parts
