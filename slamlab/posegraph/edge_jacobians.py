"""Jacobians of a pose-graph edge's residual, derived in :mod:`slamlab.posegraph.edge_symbolic`."""

import numpy as np


def J_i(x_i, x_j, z):
    """Jacobian ∂e/∂x_i: [[−Rᵀ, Rᵀ(y_j−y_i, x_i−x_j)], [0, −1]], R=Rot(θ_i+θ_z). Equation (15.3)."""
    x_i, x_j = np.asarray(x_i, dtype=float), np.asarray(x_j, dtype=float)
    J = -J_j(x_i, x_j, z)
    dx, dy = x_j[..., 0] - x_i[..., 0], x_j[..., 1] - x_i[..., 1]
    # a rotation of pose i rotates its measurement in the opposite sense; J begins with −Rᵀ
    J[..., 0, 2] = J[..., 0, 1] * dx - J[..., 0, 0] * dy
    J[..., 1, 2] = J[..., 1, 1] * dx - J[..., 1, 0] * dy
    return J


def J_j(x_i, x_j, z):
    """Jacobian ∂e/∂x_j: [[Rᵀ, 0], [0, 1]], R = Rot(θ_i+θ_z). Equation (15.3)."""
    angle = np.asarray(x_i, dtype=float)[..., 2] + np.asarray(z, dtype=float)[..., 2]
    c, s = np.cos(angle), np.sin(angle)
    J = np.zeros((*angle.shape, 3, 3))
    J[..., 0, 0], J[..., 0, 1] = c, s
    J[..., 1, 0], J[..., 1, 1] = -s, c
    J[..., 2, 2] = 1
    return J
