"""The region a sighting leaves, by its edges: lines, each with a valid half-plane (MAK 5.2.6).

A half-plane (a, b, c) is all (x, y) with a x + b y ≤ c, (a, b) being a unit vector that points out.
"""

from math import cos, pi, sin

from slamlab.filters.bor.angles import middle
from slamlab.filters.bor.intervals import ROUNDING, around, width
from slamlab.filters.bor.predict import moved

SIDES = (1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)
"""Which way the four sides of a box look."""


def sighting(heading, z, bounds):
    """The absolute bearing of a sighting, and its half-width: β + θ, and d_abs = d_β + d_θ (5.2.5).

    Parameters
    ----------
    heading : (right, left) of the robot [rad]
    z, bounds : (range, bearing) and the most that they are off [m, rad]

    Returns
    -------
    direction, d_abs : float [rad]
    """
    return middle(heading) + z[1], bounds[1] + width(heading) / 2


def edges(z, bounds, direction, d_abs, origin):
    """The edges of all places seen at r ± dr, direction ± d_abs from somewhere in a box.

    Far: r + dr. Near: (r − dr) cos d_abs, where the chord between the ends of the inner arc lies.
    Sides: the rays at ± d_abs. Each is pushed out by the farthest point of the origin's box.

    Parameters
    ----------
    z, bounds : (range, bearing) and the most that they are off; the ranges count [m, rad]
    direction, d_abs : float, absolute bearing and its half-width [rad]
    origin : (x_min, x_max, y_min, y_max) [m]

    Returns
    -------
    far, near, left, right : half-planes (a, b, c). Where d_abs ≥ π/2 these would cut off places
    that are possible; there only the range counts: the four sides of the square round r + dr.
    """
    r, dr = z[0], bounds[0]
    if d_abs >= pi / 2:
        return tuple(pushed(a, b, r + dr, origin) for a, b in SIDES)
    u, left, right = direction, direction + d_abs, direction - d_abs
    return (
        pushed(cos(u), sin(u), r + dr, origin),
        pushed(-cos(u), -sin(u), -max(r - dr, 0.0) * cos(d_abs), origin),
        pushed(-sin(left), cos(left), 0.0, origin),
        pushed(sin(right), -cos(right), 0.0, origin),
    )


def reversed_edges(z, bounds, direction, d_abs, target):
    """The edges of all places from which a box is seen so: the sighting turned by π (5.2.7).

    Parameters and result as those of :func:`edges`, ``target`` being the box of what is seen.
    """
    return edges(z, bounds, direction + pi, d_abs, target)


def pushed(a, b, c, origin):
    """An edge as seen from one point, pushed out to hold for every point of a box.

    c' = c + max (a x + b y) over the box

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


def place(robot, heading, z, bounds):
    """The smallest box of all places that may be seen so, from anywhere in the robot's box.

    Parameters
    ----------
    robot : (x_min, x_max, y_min, y_max) [m]
    heading : (right, left) [rad]
    z, bounds : (range, bearing) and the most that they are off [m, rad]

    Returns
    -------
    (x_min, x_max, y_min, y_max) [m]
    """
    (near, far), bearing = around(z[0], bounds[0]), around(z[1], bounds[1])
    # a sighting is a drive that is only looked along
    box, _ = moved(robot, heading, (max(near, 0.0), far), bearing, (0.0, 0.0))
    return box
