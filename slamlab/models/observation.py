"""Observation models (measurement models) h and their inverses g: range and bearing, lines.

Their Jacobians are in :mod:`slamlab.models.jacobians`, their derivation in
:mod:`slamlab.models.symbolic`.
"""

import numpy as np

from slamlab.geometry import wrap


def h(x, p):
    """Range-bearing observation model: landmarks seen from a pose (Smolec (1) with atan2).

    r = |p − t|,  β = atan2(p_y − y, p_x − x) − θ. Equation (04.8).

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
    """Inverse observation model: the landmark that a pose sees at range and bearing.

    p = t + r [cos(θ+β), sin(θ+β)]. Equation (04.13).

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
    """Line observation model: distance and direction of a wall's line seen from a pose.

    ρ' = ρ − x cos α − y sin α,  α' = α − θ, for the line of all p with p_x cos α + p_y sin α = ρ.
    Equation (08.10).

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
    """Inverse line observation model: the line that a pose sees at a distance and direction.

    α = θ + α',  ρ = ρ' + x cos α + y sin α. Equation (09.2).

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
