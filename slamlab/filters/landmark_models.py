"""Landmark models: point landmarks (range and bearing) and line landmarks (walls).

Each gives the observation model h, its inverse g and both Jacobians; two numbers a landmark.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from slamlab.geometry import wrap
from slamlab.models import jacobians, observation


@dataclass(frozen=True)
class LandmarkModel:
    """Observation model of a kind of landmark: h, inverse g, and their Jacobians H and J.

    Parameters
    ----------
    h : (x, p) -> (..., 2) expected observation from a pose; its second component is an angle
    g : (x, z) -> (..., 2) inverse observation model: the landmarks so observed
    H : (x, p) -> (..., 2, 3), (..., 2, 2) Jacobians of h by the pose and the landmark
    J : (x, z) -> (..., 2, 3), (..., 2, 2) Jacobians of g by the pose and the observation
    minus : (p, q) -> (..., 2) how landmark p differs from q; where a number is an angle, wrapped
    """

    h: Callable
    g: Callable
    H: Callable
    J: Callable
    minus: Callable = np.subtract


def _point_jacobians(x, p):
    H_r = jacobians.H_robot(x, p)
    return H_r, -H_r[..., :2]


def _line_difference(p, q):
    d = np.subtract(p, q)
    d[..., 1] = wrap(d[..., 1])
    return d


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
    _line_difference,
)


Kind = LandmarkModel  # name in the first edition
