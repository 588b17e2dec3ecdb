"""Half-planes a x + b y ≤ c, (a, b) a unit vector, of an observation's feasible set (MAK 5.2.6)."""

from math import cos, pi, sin

from slamlab.filters.set_membership.angle_intervals import midpoint
from slamlab.filters.set_membership.intervals import ROUNDING, around, width
from slamlab.filters.set_membership.prediction import predict_box

SIDE_NORMALS = (1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)
"""Outward unit normals of the four sides of a box."""


def absolute_bearing(heading, z, bounds):
    """Return absolute bearing β + θ and half-width d_abs = d_β + d_θ (5.2.5). Equation (10.5)."""
    return midpoint(heading) + z[1], bounds[1] + width(heading) / 2


def edges(z, bounds, direction, d_abs, origin):
    """Return the edges far, near, left, right of the positions that are at range r ± dr and
    direction ± d_abs from some point of a box."""
    r, dr = z[0], bounds[0]
    if d_abs >= pi / 2:  # edges of a sector would exclude feasible positions: use only the range
        return tuple(offset_edge(a, b, r + dr, origin) for a, b in SIDE_NORMALS)
    return tuple(offset_edge(*edge, origin) for edge in sector_edges(r, dr, direction, d_abs))


def sector_edges(r, dr, direction, d_abs):
    """Edges far, near, left, right of an annular sector around 0, d_abs < π/2. Equation (10.6).

    Far: r + dr. Near: (r − dr) cos d_abs, the chord of the inner arc. Sides: the rays at ± d_abs.
    """
    u, left, right = direction, direction + d_abs, direction - d_abs
    return (
        (cos(u), sin(u), r + dr),
        (-cos(u), -sin(u), -max(r - dr, 0.0) * cos(d_abs)),
        (-sin(left), cos(left), 0.0),
        (sin(right), -cos(right), 0.0),
    )


def reversed_edges(z, bounds, direction, d_abs, target):
    """Return the edges of positions from which a box is observed: rotated by π (5.2.7)."""
    return edges(z, bounds, direction + pi, d_abs, target)


def offset_edge(a, b, c, origin):
    """The Minkowski sum of a half-plane and a box of origins: c + max(ax + by). Equation (10.8)."""
    x_min, x_max, y_min, y_max = origin
    farthest = a * (x_max if a > 0 else x_min) + b * (y_max if b > 0 else y_min)
    return a, b, c + farthest + ROUNDING


def landmark_box(robot, heading, z, bounds):
    """Return the bounding box of all positions of a new landmark that an observation allows."""
    (near, far), bearing = around(z[0], bounds[0]), around(z[1], bounds[1])
    # an observation is computed like a motion from the robot to the landmark
    box, _ = predict_box(robot, heading, (max(near, 0.0), far), bearing, (0.0, 0.0))
    return box
