"""Motion and observation models: f, h and its inverse g, as plain functions over arrays.

Their Jacobians live in :mod:`slamlab.jacobians`, their derivation in :mod:`slamlab.symbolic`.
"""

import numpy as np

from slamlab.geometry import wrap


def f_odometry(x, u):
    """Drive a distance along the old heading, then turn (Smolec (4), mended).

    x' = x + d cos θ,  y' = y + d sin θ,  θ' = θ + Δθ

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
    """Drive a steered robot for one period (MAK thesis, chapter 3).

    x' = x + T V cos(θ+γ),  y' = y + T V sin(θ+γ),  θ' = θ + (T V / B) sin γ

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


def h(x, p):
    """Range and bearing of landmarks seen from a pose (Smolec (1) with atan2).

    r = |p − t|,  β = atan2(p_y − y, p_x − x) − θ

    Parameters
    ----------
    x : (..., 3) pose [m, m, rad], broadcast against the landmarks
    p : (..., 2) landmarks [m]

    Returns
    -------
    (..., 2) range [m] and bearing [rad], wrapped
    """
    x = np.asarray(x, dtype=float)
    d = np.asarray(p, dtype=float) - x[..., :2]
    z = np.empty_like(d)
    z[..., 0] = np.hypot(d[..., 0], d[..., 1])
    z[..., 1] = wrap(np.arctan2(d[..., 1], d[..., 0]) - x[..., 2])
    return z


def g(x, z):
    """The landmark that a pose sees at range and bearing: the inverse of h.

    p = t + r [cos(θ+β), sin(θ+β)]

    Parameters
    ----------
    x : (..., 3) pose [m, m, rad], broadcast against the sightings
    z : (..., 2) range [m] and bearing [rad]

    Returns
    -------
    (..., 2) landmarks [m]
    """
    x, z = np.asarray(x, dtype=float), np.asarray(z, dtype=float)
    r, direction = z[..., 0], x[..., 2] + z[..., 1]
    ends = x[..., 0] + r * np.cos(direction), x[..., 1] + r * np.sin(direction)
    return np.stack(ends, axis=-1)


def h_line(x, line):
    """Distance and direction of a wall's line seen from a pose.

    ρ' = ρ − x cos α − y sin α,  α' = α − θ, for the line of all (a, b) with a cos α + b sin α = ρ

    The normal keeps pointing the way it did when the line was placed, so ρ' is negative for whom
    has gone through the wall; nothing jumps there.

    Parameters
    ----------
    x : (3,) pose [m, m, rad]
    line : (..., 2) ρ [m] and α [rad]

    Returns
    -------
    (..., 2) ρ' [m] and α' [rad], wrapped
    """
    line = np.asarray(line, dtype=float)
    rho, alpha = line[..., 0], line[..., 1]
    distance = rho - x[0] * np.cos(alpha) - x[1] * np.sin(alpha)
    return np.stack([distance, wrap(alpha - x[2])], axis=-1)


def g_line(x, z):
    """The line that a pose sees at a distance and direction: the inverse of h_line.

    α = θ + α',  ρ = ρ' + x cos α + y sin α

    Parameters
    ----------
    x : (3,) pose [m, m, rad]
    z : (..., 2) ρ' [m] and α' [rad]

    Returns
    -------
    (..., 2) lines: ρ [m] and α [rad], wrapped
    """
    z = np.asarray(z, dtype=float)
    alpha = wrap(x[2] + z[..., 1])
    rho = z[..., 0] + x[0] * np.cos(alpha) + x[1] * np.sin(alpha)
    return np.stack([rho, alpha], axis=-1)
