"""Jacobians (linearisation): A and W of the motion model, H of the measurement model, J_xr and J_z
of its inverse (landmark initialisation).

Names that end in ``_line`` are for line landmarks. Derived in :mod:`slamlab.models.symbolic`.
"""

import numpy as np


def A_odometry(x, u):
    """Jacobian of the motion model: ∂f/∂x = [[1, 0, −Δy], [0, 1, Δx], [0, 0, 1]]. Equation (04.5).
    Smolec §4.1.

    x : (3,) [m, m, rad]; u : (2,) [m, rad]. Returns (3, 3).
    """
    d = u[0]
    return np.array([[1, 0, -d * np.sin(x[2])], [0, 1, d * np.cos(x[2])], [0, 0, 1.0]])


def W_odometry(x, u):
    """Jacobian of the motion model: ∂f/∂u = [[cos θ, 0], [sin θ, 0], [0, 1]]. Equation (04.6).

    x : (3,) [m, m, rad]; u : (2,) [m, rad]. Returns (3, 2).
    """
    return np.array([[np.cos(x[2]), 0], [np.sin(x[2]), 0], [0, 1.0]])


def A_steered(x, u, B, T):
    """Jacobian of the motion model ``f_steered``: ∂f/∂x (MAK thesis, chapter 3). Returns (3, 3).

    Parameters
    ----------
    x, u : (3,) [m, m, rad], (2,) [m/s, rad]
    B, T : float [m], [s]
    """
    V, gamma = u
    direction = x[2] + gamma
    return np.array(
        [[1, 0, -T * V * np.sin(direction)], [0, 1, T * V * np.cos(direction)], [0, 0, 1.0]]
    )


def W_steered(x, u, B, T):
    """Jacobian of the motion model ``f_steered``: ∂f/∂u (MAK thesis, chapter 3). Returns (3, 2).

    Parameters
    ----------
    x, u : (3,) [m, m, rad], (2,) [m/s, rad]
    B, T : float [m], [s]
    """
    V, gamma = u
    c, s = np.cos(x[2] + gamma), np.sin(x[2] + gamma)
    return T * np.array([[c, -V * s], [s, V * c], [np.sin(gamma) / B, V * np.cos(gamma) / B]])


def H_robot(x, p):
    """Jacobian of the measurement model: ∂h/∂x (Smolec (2), sign corrected). Equation (04.9).

    [[(x−p_x)/r, (y−p_y)/r, 0], [(p_y−y)/r², (x−p_x)/r², −1]]

    x : (..., 3) [m, m, rad]; p : (..., 2) [m]. Returns (..., 2, 3).
    """
    d = np.asarray(p, dtype=float) - np.asarray(x, dtype=float)[..., :2]
    dx, dy = d[..., 0], d[..., 1]
    q = dx * dx + dy * dy
    r = np.sqrt(q)
    H = np.zeros((*q.shape, 2, 3))
    H[..., 0, 0], H[..., 0, 1] = -dx / r, -dy / r
    H[..., 1, 0], H[..., 1, 1], H[..., 1, 2] = dy / q, -dx / q, -1
    return H


def H_landmark(x, p):
    """Jacobian of the measurement model: ∂h/∂p (Smolec (3)). Equation (04.10).

    x : (..., 3) [m, m, rad]; p : (..., 2) [m]. Returns (..., 2, 2).
    """
    return -H_robot(x, p)[..., :2]


def J_xr(x, z):
    """Jacobian of the inverse measurement model: ∂g/∂x = [[1, 0, −r sin(θ+β)], [0, 1, r cos(θ+β)]]
    (Smolec (10), corrected). Equation (04.14).

    x : (3,) [m, m, rad]; z : (..., 2) [m, rad]. Returns (..., 2, 3).
    """
    z = np.asarray(z, dtype=float)
    r, direction = z[..., 0], x[2] + z[..., 1]
    J = np.zeros((*r.shape, 2, 3))
    J[..., 0, 0] = J[..., 1, 1] = 1
    J[..., 0, 2], J[..., 1, 2] = -r * np.sin(direction), r * np.cos(direction)
    return J


def J_z(x, z):
    """Jacobian of the inverse measurement model: ∂g/∂z (Smolec (11), corrected). Equation (04.14).

    [[cos(θ+β), −r sin(θ+β)], [sin(θ+β), r cos(θ+β)]]

    x : (..., 3) [m, m, rad]; z : (..., 2) [m, rad]. Returns (..., 2, 2).
    """
    x, z = np.asarray(x, dtype=float), np.asarray(z, dtype=float)
    r, direction = z[..., 0], x[..., 2] + z[..., 1]
    c, s = np.cos(direction), np.sin(direction)
    return np.stack([np.stack([c, -r * s], -1), np.stack([s, r * c], -1)], -2)


def H_robot_line(x, line):
    """Jacobian of the measurement model: ∂h_line/∂x = [[−cos α, −sin α, 0], [0, 0, −1]].

    x : (3,) [m, m, rad]; line : (..., 2) [m, rad]. Returns (..., 2, 3).
    """
    alpha = np.asarray(line, dtype=float)[..., 1]
    H = np.zeros((*alpha.shape, 2, 3))
    H[..., 0, 0], H[..., 0, 1], H[..., 1, 2] = -np.cos(alpha), -np.sin(alpha), -1
    return H


def H_line(x, line):
    """Jacobian of the measurement model: ∂h_line/∂line = [[1, x sin α − y cos α], [0, 1]].

    x : (3,) [m, m, rad]; line : (..., 2) [m, rad]. Returns (..., 2, 2).
    """
    alpha = np.asarray(line, dtype=float)[..., 1]
    H = np.zeros((*alpha.shape, 2, 2))
    H[..., 0, 0] = H[..., 1, 1] = 1
    H[..., 0, 1] = x[0] * np.sin(alpha) - x[1] * np.cos(alpha)
    return H


def J_xr_line(x, z):
    """Jacobian of g_line: ∂g_line/∂x = [[cos α, sin α, −x sin α + y cos α], [0, 0, 1]], α = θ + α'.

    x : (3,) [m, m, rad]; z : (..., 2) [m, rad]. Returns (..., 2, 3).
    """
    alpha = x[2] + np.asarray(z, dtype=float)[..., 1]
    c, s = np.cos(alpha), np.sin(alpha)
    J = np.zeros((*alpha.shape, 2, 3))
    J[..., 0, 0], J[..., 0, 1], J[..., 0, 2] = c, s, x[1] * c - x[0] * s
    J[..., 1, 2] = 1
    return J


def J_z_line(x, z):
    """Jacobian of g_line: ∂g_line/∂z = [[1, −x sin α + y cos α], [0, 1]], α = θ + α'.

    x : (3,) [m, m, rad]; z : (..., 2) [m, rad]. Returns (..., 2, 2).
    """
    J = np.zeros((*np.shape(z)[:-1], 2, 2))
    J[..., 0, 0] = J[..., 1, 1] = 1
    J[..., 0, 1] = J_xr_line(x, z)[..., 0, 2]
    return J
