"""Half-planes of an observation: edges of the region that it allows (MAK 5.2.6).

A half-plane (a, b, c) is all (x, y) with a x + b y ≤ c, (a, b) being a unit vector that points out.
"""

from math import cos, pi, sin

from slamlab.filters.bor.angle_intervals import midpoint
from slamlab.filters.bor.intervals import ROUNDING, around, width
from slamlab.filters.bor.prediction import predict_box

SIDE_NORMALS = (1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)
"""Outward unit normals of the four sides of a box."""


def absolute_bearing(heading, z, bounds):
    """Absolute bearing of an observation and its half-width: β + θ, d_abs = d_β + d_θ (5.2.5).

    Equation (10.5).

    Parameters
    ----------
    heading : (right, left) of the robot [rad]
    z, bounds : (range, bearing) and their error bounds [m, rad]

    Returns
    -------
    direction, d_abs : float [rad]
    """
    return midpoint(heading) + z[1], bounds[1] + width(heading) / 2


def edges(z, bounds, direction, d_abs, origin):
    """Half-planes (edges) of the places observed at r ± dr, direction ± d_abs from a box.

    Far: r + dr. Near: (r − dr) cos d_abs, where the chord between the ends of the inner arc lies.
    Sides: the rays at ± d_abs. Each is pushed out by the farthest point of the origin's box.

    Parameters
    ----------
    z, bounds : (range, bearing) and their error bounds; the ranges count [m, rad]
    direction, d_abs : float, absolute bearing and its half-width [rad]
    origin : (x_min, x_max, y_min, y_max) [m]

    Returns
    -------
    far, near, left, right : half-planes (a, b, c). Where d_abs ≥ π/2 these would cut off places
    that are possible; there only the range counts: the four sides of the square round r + dr.
    """
    r, dr = z[0], bounds[0]
    if d_abs >= pi / 2:
        return tuple(offset_edge(a, b, r + dr, origin) for a, b in SIDE_NORMALS)
    return tuple(offset_edge(*edge, origin) for edge in sector_edges(r, dr, direction, d_abs))


def sector_edges(r, dr, direction, d_abs):
    """Half-planes (edges) of a sector of a ring as seen from the origin; valid for d_abs < π/2.

    Equation (10.6).

    Parameters
    ----------
    r, dr : float, range and its bound [m]
    direction, d_abs : float, absolute bearing and its half-width [rad]

    Returns
    -------
    far, near, left, right : half-planes (a, b, c)
    """
    u, left, right = direction, direction + d_abs, direction - d_abs
    return (
        (cos(u), sin(u), r + dr),
        (-cos(u), -sin(u), -max(r - dr, 0.0) * cos(d_abs)),
        (-sin(left), cos(left), 0.0),
        (sin(right), -cos(right), 0.0),
    )


def reversed_edges(z, bounds, direction, d_abs, target):
    """Half-planes (edges) of the places from which a box is so observed: turned by π (5.2.7).

    Parameters and result as those of :func:`edges`, ``target`` being the box of the landmark.
    """
    return edges(z, bounds, direction + pi, d_abs, target)


def offset_edge(a, b, c, origin):
    """Offset a half-plane to hold for every origin in a box (Minkowski sum with the box).

    c' = c + max (a x + b y) over the box. Equation (10.8).

    Parameters
    ----------
    a, b, c : float, the half-plane relative to the point
    origin : (x_min, x_max, y_min, y_max) [m]

    Returns
    -------
    (a, b, c') half-plane
    """
    x_min, x_max, y_min, y_max = origin
    farthest = a * (x_max if a > 0 else x_min) + b * (y_max if b > 0 else y_min)
    return a, b, c + farthest + ROUNDING


def landmark_box(robot, heading, z, bounds):
    """Bounding box of a new landmark: all places that an observation allows (initialisation).

    Parameters
    ----------
    robot : (x_min, x_max, y_min, y_max) [m]
    heading : (right, left) [rad]
    z, bounds : (range, bearing) and their error bounds [m, rad]

    Returns
    -------
    (x_min, x_max, y_min, y_max) [m]
    """
    (near, far), bearing = around(z[0], bounds[0]), around(z[1], bounds[1])
    # an observation is a motion that is only looked along
    box, _ = predict_box(robot, heading, (max(near, 0.0), far), bearing, (0.0, 0.0))
    return box
