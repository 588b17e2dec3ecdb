"""Residual (error) of a pose-graph edge (factor), and its information matrix."""

import numpy as np

from slamlab.geometry import between


def error(x_i, x_j, z):
    """Residual e = z⁻¹ ⊕ (x_i⁻¹ ⊕ x_j), in the frame at the end of z. Equation (15.2)."""
    return between(z, between(x_i, x_j))


def information(z, covariance):
    """Information matrix of e, Λ_e = Tᵀ P⁻¹ T, T = diag(Rot(θ_z), 1), P = cov(z). Equation (15.7).

    z = m + n has the noise n in the frame of pose i; for the true motion m, e = z⁻¹ ⊕ m = −Tᵀ n.
    """
    angle = np.asarray(z, dtype=float)[..., 2]
    c, s = np.cos(angle), np.sin(angle)
    T = np.zeros((*angle.shape, 3, 3))
    T[..., 0, 0], T[..., 0, 1] = c, -s
    T[..., 1, 0], T[..., 1, 1] = s, c
    T[..., 2, 2] = 1
    turned = T.swapaxes(-1, -2) @ np.linalg.inv(np.asarray(covariance, dtype=float)) @ T
    return (turned + turned.swapaxes(-1, -2)) / 2


def squared_distances(e, covariance):
    """Squared Mahalanobis distances (c,) of residuals e (c, 3), given covariances (c, 3, 3)."""
    return np.einsum("ca,ca->c", e, np.linalg.solve(covariance, e[..., None])[..., 0])
