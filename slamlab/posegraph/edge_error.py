"""Residual (error) of a pose-graph edge, and its information matrix from the covariance of z."""

import numpy as np

from slamlab.geometry import between


def error(x_i, x_j, z):
    """Residual e = z⁻¹ ⊕ (x_i⁻¹ ⊕ x_j): zero where pose j is as measured (Grisetti et al. 2010).

    Equation (15.2).

    Parameters
    ----------
    x_i, x_j : (..., 3) poses [m, m, rad]
    z : (..., 3) measured pose of j as seen from i [m, m, rad]

    Returns
    -------
    (..., 3) [m, m, rad], the angle wrapped, in the frame that z leads to
    """
    return between(z, between(x_i, x_j))


def information(z, covariance):
    """Information matrix of e, Λ_e = Tᵀ P⁻¹ T with T = diag(Rot(θ_z), 1), P that of z.

    A measured motion z errs by n in the frame of pose i: z = m + n, m the true motion. From there e
    is seen turned back: e = z⁻¹ ⊕ m = −Tᵀ n, exactly. So P_e = Tᵀ P T, and Λ_e is its inverse. Of
    all that hand a covariance to a graph this is the one place where it is turned. Equation (15.7).

    Parameters
    ----------
    z : (..., 3) measured pose of j as seen from i [m, m, rad]
    covariance : (..., 3, 3) P, of the numbers x, y and θ of z, as a match or odometry gives it

    Returns
    -------
    (..., 3, 3) symmetric
    """
    angle = np.asarray(z, dtype=float)[..., 2]
    c, s = np.cos(angle), np.sin(angle)
    T = np.zeros((*angle.shape, 3, 3))
    T[..., 0, 0], T[..., 0, 1] = c, -s
    T[..., 1, 0], T[..., 1, 1] = s, c
    T[..., 2, 2] = 1
    turned = T.swapaxes(-1, -2) @ np.linalg.inv(np.asarray(covariance, dtype=float)) @ T
    return (turned + turned.swapaxes(-1, -2)) / 2
