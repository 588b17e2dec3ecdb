"""Measurement models (observation models) h and their inverses g: range and bearing, lines."""

import numpy as np

from slamlab.geometry import wrap


def h(x, p):
    """Range-bearing measurement model (Smolec (1) with atan2). Equation (04.8).

    r = |p − t|,  β = atan2(p_y − y, p_x − x) − θ

    Returns (..., 2) r [m], β [rad], wrapped.

    Parameters
    ----------
    x : (..., 3) poses [m, m, rad]
    p : (..., 2) landmarks [m]
    """
    x = np.asarray(x, dtype=float)
    d = np.asarray(p, dtype=float) - x[..., :2]
    z = np.empty_like(d)
    z[..., 0] = np.hypot(d[..., 0], d[..., 1])
    z[..., 1] = wrap(np.arctan2(d[..., 1], d[..., 0]) - x[..., 2])
    return z


def g(x, z):
    """Inverse measurement model (inverse observation model): p = t + r [cos(θ+β), sin(θ+β)].
    Equation (04.13). Returns (..., 2) landmarks [m].

    Parameters
    ----------
    x : (..., 3) poses [m, m, rad]
    z : (..., 2) r [m], β [rad]
    """
    x, z = np.asarray(x, dtype=float), np.asarray(z, dtype=float)
    r, direction = z[..., 0], x[..., 2] + z[..., 1]
    ends = x[..., 0] + r * np.cos(direction), x[..., 1] + r * np.sin(direction)
    return np.stack(ends, axis=-1)


def h_line(x, line):
    """Measurement model of a line in Hessian normal form, p_x cos α + p_y sin α = ρ.
    Equation (08.10).

    ρ' = ρ − x cos α − y sin α,  α' = α − θ; behind the wall ρ' is negative.

    Returns (..., 2) ρ' [m], α' [rad], wrapped.

    Parameters
    ----------
    x : (3,) pose [m, m, rad]
    line : (..., 2) ρ [m], α [rad]
    """
    line = np.asarray(line, dtype=float)
    rho, alpha = line[..., 0], line[..., 1]
    distance = rho - x[0] * np.cos(alpha) - x[1] * np.sin(alpha)
    return np.stack([distance, wrap(alpha - x[2])], axis=-1)


def g_line(x, z):
    """Inverse measurement model of a line: α = θ + α', ρ = ρ' + x cos α + y sin α. Equation (09.2).
    Returns (..., 2) ρ [m], α [rad], wrapped.

    Parameters
    ----------
    x : (3,) pose [m, m, rad]
    z : (..., 2) ρ' [m], α' [rad]
    """
    z = np.asarray(z, dtype=float)
    alpha = wrap(x[2] + z[..., 1])
    rho = z[..., 0] + x[0] * np.cos(alpha) + x[1] * np.sin(alpha)
    return np.stack([rho, alpha], axis=-1)
