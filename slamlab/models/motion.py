"""Motion models f: odometry increment; speed and steering (bicycle)."""

import numpy as np

from slamlab.geometry import wrap


def f_odometry(x, u):
    """Odometry motion model: a distance, then a turn (Smolec (4), corrected). Equation (04.4).

    x' = x + d cos θ,  y' = y + d sin θ,  θ' = θ + Δθ

    Returns (3,).

    Parameters
    ----------
    x : (3,) pose [m, m, rad]
    u : (2,) d [m], Δθ [rad]
    """
    d, turn = u
    return np.array([x[0] + d * np.cos(x[2]), x[1] + d * np.sin(x[2]), wrap(x[2] + turn)])


def f_steered(x, u, B, T):
    """Steered (bicycle, Ackermann) motion model (MAK thesis, chapter 3). Equation (04.18).

    x' = x + T V cos(θ+γ),  y' = y + T V sin(θ+γ),  θ' = θ + (T V / B) sin γ

    Returns (3,).

    Parameters
    ----------
    x : (3,) pose [m, m, rad]
    u : (2,) speed V [m/s], steering angle γ [rad]
    B, T : float, wheel base [m], period [s]
    """
    V, gamma = u
    return np.array(
        [
            x[0] + T * V * np.cos(x[2] + gamma),
            x[1] + T * V * np.sin(x[2] + gamma),
            wrap(x[2] + T * V / B * np.sin(gamma)),
        ]
    )
