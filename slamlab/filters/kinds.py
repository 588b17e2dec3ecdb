"""The kinds of landmark a map can hold: points seen by range and bearing, and walls' lines.

Each says how it is seen (h), placed (g), and how both change; two numbers a landmark.
"""

from collections.abc import Callable
from dataclasses import dataclass

from slamlab import jacobians, models


@dataclass(frozen=True)
class Kind:
    """What a filter has to know of its landmarks.

    Parameters
    ----------
    h : (x, p) -> (..., 2) how landmarks look from a pose; its second component is an angle
    g : (x, z) -> (..., 2) the landmarks that look so
    H : (x, p) -> (..., 2, 3), (..., 2, 2) slopes of h by the pose and by the landmark
    J : (x, z) -> (..., 2, 3), (..., 2, 2) slopes of g by the pose and by the sighting
    """

    h: Callable
    g: Callable
    H: Callable
    J: Callable


def _H_points(x, p):
    H_r = jacobians.H_robot(x, p)
    return H_r, -H_r[..., :2]


POINTS = Kind(
    models.h,
    models.g,
    _H_points,
    lambda x, z: (jacobians.J_xr(x, z), jacobians.J_z(x, z)),
)
LINES = Kind(
    models.h_line,
    models.g_line,
    lambda x, line: (jacobians.H_robot_line(x, line), jacobians.H_line(x, line)),
    lambda x, z: (jacobians.J_xr_line(x, z), jacobians.J_z_line(x, z)),
)
