"""The textbook forms the fast filters are held equal to: whole matrices, nothing left out."""

import numpy as np

from slamlab import models
from slamlab.geometry import wrap
from slamlab.models import jacobians


def predict(x, P, x_new, Q):
    """P ← A P Aᵀ + Q over the whole state."""
    A = np.eye(len(x))
    A[0, 2], A[1, 2] = x[1] - x_new[1], x_new[0] - x[0]
    grown = A @ P @ A.T
    grown[:3, :3] += Q
    return np.concatenate([x_new, x[3:]]), grown


def update(x, P, slots, z, R):
    """One scan at once, H dense, Joseph's form."""
    H = np.zeros((2 * len(slots), len(x)))
    v = np.empty((len(slots), 2))
    for k, j in enumerate(slots):
        p = x[3 + 2 * j : 5 + 2 * j]
        H[2 * k : 2 * k + 2, :3] = jacobians.H_robot(x, p)
        H[2 * k : 2 * k + 2, 3 + 2 * j : 5 + 2 * j] = jacobians.H_landmark(x, p)
        v[k] = z[k] - models.h(x, p)
        v[k, 1] = wrap(v[k, 1])
    R = np.kron(np.eye(len(slots)), R)
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    I_KH = np.eye(len(x)) - K @ H
    x = x + K @ v.ravel()
    x[2] = wrap(x[2])
    return x, I_KH @ P @ I_KH.T + K @ R @ K.T


def add(x, P, z, R):
    """Landmarks enter one after the other, block by block."""
    for row in z:
        n = len(x)
        J_xr, J_z = jacobians.J_xr(x, row), jacobians.J_z(x, row)
        bigger = np.empty((n + 2, n + 2))
        bigger[:n, :n] = P
        bigger[n:, :n] = J_xr @ P[:3, :]
        bigger[:n, n:] = bigger[n:, :n].T
        bigger[n:, n:] = J_xr @ P[:3, :3] @ J_xr.T + J_z @ R @ J_z.T
        x, P = np.concatenate([x, models.g(x, row)]), bigger
    return x, P


def random_covariance(rng, n, scale=1.0):
    """(n, n) a covariance with every entry at work."""
    root = rng.normal(size=(n, n))
    return scale * (root @ root.T / n + np.eye(n))
