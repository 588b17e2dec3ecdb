"""Jacobians (linearisation): A and W of motion, H of observation, J_xr and J_z of a new landmark.

Those that end in ``_line`` are of walls' lines, the others of point landmarks.

Each equals its derivation in :mod:`slamlab.models.symbolic` and finite differences of the model.
"""

import numpy as np


def A_odometry(x, u):
    """Jacobian ∂f/∂x of the odometry model: [[1, 0, −Δy], [0, 1, Δx], [0, 0, 1]] (Smolec §4.1).

    Equation (04.5).

    Parameters
    ----------
    x : (3,) pose [m, m, rad]
    u : (2,) distance d [m], turn Δθ [rad]

    Returns
    -------
    (3, 3)
    """
    d = u[0]
    return np.array([[1, 0, -d * np.sin(x[2])], [0, 1, d * np.cos(x[2])], [0, 0, 1.0]])


def W_odometry(x, u):
    """Jacobian ∂f/∂u of the odometry motion model, by the odometry increment. Equation (04.6).

    Parameters
    ----------
    x : (3,) pose [m, m, rad]
    u : (2,) distance d [m], turn Δθ [rad]

    Returns
    -------
    (3, 2)
    """
    return np.array([[np.cos(x[2]), 0], [np.sin(x[2]), 0], [0, 1.0]])


def A_steered(x, u, B, T):
    """Jacobian ∂f/∂x of the steered motion model (MAK thesis, chapter 3).

    Parameters
    ----------
    x : (3,) pose [m, m, rad]
    u : (2,) speed V [m/s], steering angle γ [rad]
    B, T : float, wheel base [m], period [s]

    Returns
    -------
    (3, 3)
    """
    V, gamma = u
    direction = x[2] + gamma
    return np.array(
        [[1, 0, -T * V * np.sin(direction)], [0, 1, T * V * np.cos(direction)], [0, 0, 1.0]]
    )


def W_steered(x, u, B, T):
    """Jacobian ∂f/∂u of the steered motion model: control noise adds to V and γ (MAK, chapter 3).

    Parameters
    ----------
    x : (3,) pose [m, m, rad]
    u : (2,) speed V [m/s], steering angle γ [rad]
    B, T : float, wheel base [m], period [s]

    Returns
    -------
    (3, 2)
    """
    V, gamma = u
    c, s = np.cos(x[2] + gamma), np.sin(x[2] + gamma)
    return T * np.array([[c, -V * s], [s, V * c], [np.sin(gamma) / B, V * np.cos(gamma) / B]])


def H_robot(x, p):
    """Observation Jacobian ∂h/∂x, the robot's part of H (Smolec (2), its sign mended).

    [[(x−p_x)/r, (y−p_y)/r, 0], [(p_y−y)/r², (x−p_x)/r², −1]]. Equation (04.9).

    Parameters
    ----------
    x : (..., 3) pose [m, m, rad], broadcast against the landmarks
    p : (..., 2) landmarks [m]

    Returns
    -------
    (..., 2, 3)
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
    """Observation Jacobian ∂h/∂p, the landmark's part of H (Smolec (3)).

    Minus the robot's x and y columns. Equation (04.10).

    Parameters
    ----------
    x : (..., 3) pose [m, m, rad], broadcast against the landmarks
    p : (..., 2) landmarks [m]

    Returns
    -------
    (..., 2, 2)
    """
    return -H_robot(x, p)[..., :2]


def J_xr(x, z):
    """Jacobian ∂g/∂x of a new landmark by the pose, to augment the state (Smolec (10), mended).

    [[1, 0, −r sin(θ+β)], [0, 1, r cos(θ+β)]]. Equation (04.14).

    Parameters
    ----------
    x : (3,) pose [m, m, rad]
    z : (..., 2) range [m], bearing [rad]

    Returns
    -------
    (..., 2, 3)
    """
    z = np.asarray(z, dtype=float)
    r, direction = z[..., 0], x[2] + z[..., 1]
    J = np.zeros((*r.shape, 2, 3))
    J[..., 0, 0] = J[..., 1, 1] = 1
    J[..., 0, 2], J[..., 1, 2] = -r * np.sin(direction), r * np.cos(direction)
    return J


def J_z(x, z):
    """Jacobian ∂g/∂z of a new landmark by measurement, to augment the state (Smolec (11), mended).

    [[cos(θ+β), −r sin(θ+β)], [sin(θ+β), r cos(θ+β)]]. Equation (04.14).

    Parameters
    ----------
    x : (..., 3) pose [m, m, rad], broadcast against the sightings
    z : (..., 2) range [m], bearing [rad]

    Returns
    -------
    (..., 2, 2)
    """
    x, z = np.asarray(x, dtype=float), np.asarray(z, dtype=float)
    r, direction = z[..., 0], x[..., 2] + z[..., 1]
    c, s = np.cos(direction), np.sin(direction)
    return np.stack([np.stack([c, -r * s], -1), np.stack([s, r * c], -1)], -2)


def H_robot_line(x, line):
    """Line observation Jacobian ∂h_line/∂x: [[−cos α, −sin α, 0], [0, 0, −1]].

    Parameters
    ----------
    x : (3,) pose [m, m, rad]
    line : (..., 2) ρ [m], α [rad]

    Returns
    -------
    (..., 2, 3)
    """
    alpha = np.asarray(line, dtype=float)[..., 1]
    H = np.zeros((*alpha.shape, 2, 3))
    H[..., 0, 0], H[..., 0, 1], H[..., 1, 2] = -np.cos(alpha), -np.sin(alpha), -1
    return H


def H_line(x, line):
    """Line observation Jacobian ∂h_line/∂line: [[1, x sin α − y cos α], [0, 1]].

    Parameters
    ----------
    x : (3,) pose [m, m, rad]
    line : (..., 2) ρ [m], α [rad]

    Returns
    -------
    (..., 2, 2)
    """
    alpha = np.asarray(line, dtype=float)[..., 1]
    H = np.zeros((*alpha.shape, 2, 2))
    H[..., 0, 0] = H[..., 1, 1] = 1
    H[..., 0, 1] = x[0] * np.sin(alpha) - x[1] * np.cos(alpha)
    return H


def J_xr_line(x, z):
    """Jacobian ∂g_line/∂x, new line: [[cos α, sin α, −x sin α + y cos α], [0, 0, 1]], α = θ + α'.

    Parameters
    ----------
    x : (3,) pose [m, m, rad]
    z : (..., 2) ρ' [m], α' [rad]

    Returns
    -------
    (..., 2, 3)
    """
    alpha = x[2] + np.asarray(z, dtype=float)[..., 1]
    c, s = np.cos(alpha), np.sin(alpha)
    J = np.zeros((*alpha.shape, 2, 3))
    J[..., 0, 0], J[..., 0, 1], J[..., 0, 2] = c, s, x[1] * c - x[0] * s
    J[..., 1, 2] = 1
    return J


def J_z_line(x, z):
    """Jacobian ∂g_line/∂z, new line: [[1, −x sin α + y cos α], [0, 1]], α = θ + α'.

    Parameters
    ----------
    x : (3,) pose [m, m, rad]
    z : (..., 2) ρ' [m], α' [rad]

    Returns
    -------
    (..., 2, 2)
    """
    J = np.zeros((*np.shape(z)[:-1], 2, 2))
    J[..., 0, 0] = J[..., 1, 1] = 1
    J[..., 0, 1] = J_xr_line(x, z)[..., 0, 2]
    return J
