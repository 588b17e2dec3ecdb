"""Landmark models: point landmarks (range and bearing) and line landmarks (walls)."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from slamlab.geometry import wrap
from slamlab.models import jacobians, observation


def difference(a, b):
    """Return the difference a − b (..., 2) of observations or lines, second component wrapped."""
    d = np.subtract(a, b)
    d[..., 1] = wrap(d[..., 1])
    return d


@dataclass(frozen=True)
class LandmarkModel:
    """Measurement model of landmarks with two parameters: h, its inverse g, and their Jacobians.

    Parameters
    ----------
    h : (x, p) -> (..., 2), the second an angle
    g : (x, z) -> (..., 2)
    H : (x, p) -> (..., 2, 3), (..., 2, 2), Jacobians of h by pose and landmark
    J : (x, z) -> (..., 2, 3), (..., 2, 2), Jacobians of g by pose and observation
    minus : (p, q) -> (..., 2) difference of landmarks, angles wrapped
    """

    h: Callable
    g: Callable
    H: Callable
    J: Callable
    minus: Callable = np.subtract


def _point_jacobians(x, p):
    H_r = jacobians.H_robot(x, p)
    return H_r, -H_r[..., :2]


POINTS = LandmarkModel(
    observation.h,
    observation.g,
    _point_jacobians,
    lambda x, z: (jacobians.J_xr(x, z), jacobians.J_z(x, z)),
)
LINES = LandmarkModel(
    observation.h_line,
    observation.g_line,
    lambda x, line: (jacobians.H_robot_line(x, line), jacobians.H_line(x, line)),
    lambda x, z: (jacobians.J_xr_line(x, z), jacobians.J_z_line(x, z)),
    difference,
)
