"""Motion models f: the pose after an odometry increment, or after speed and steering (bicycle).

Their Jacobians are in :mod:`slamlab.models.jacobians`, their derivation in
:mod:`slamlab.models.symbolic`.
"""

import numpy as np

from slamlab.geometry import wrap


def f_odometry(x, u):
    """Odometry motion model: a distance along the old heading, then a turn (Smolec (4), mended).

    x' = x + d cos θ,  y' = y + d sin θ,  θ' = θ + Δθ. Equation (04.4).

    Parameters
    ----------
    x : (3,) pose [m, m, rad]
    u : (2,) distance d [m], turn Δθ [rad]

    Returns
    -------
    (3,) pose [m, m, rad]
    """
    d, turn = u
    return np.array([x[0] + d * np.cos(x[2]), x[1] + d * np.sin(x[2]), wrap(x[2] + turn)])


def f_steered(x, u, B, T):
    """Steered (bicycle, Ackermann) motion model over one period (MAK thesis, chapter 3).

    x' = x + T V cos(θ+γ),  y' = y + T V sin(θ+γ),  θ' = θ + (T V / B) sin γ. Equation (04.18).

    Parameters
    ----------
    x : (3,) pose [m, m, rad]
    u : (2,) speed V [m/s], steering angle γ [rad]
    B : float, wheel base [m]
    T : float, period [s]

    Returns
    -------
    (3,) pose [m, m, rad]
    """
    V, gamma = u
    return np.array(
        [
            x[0] + T * V * np.cos(x[2] + gamma),
            x[1] + T * V * np.sin(x[2] + gamma),
            wrap(x[2] + T * V / B * np.sin(gamma)),
        ]
    )
