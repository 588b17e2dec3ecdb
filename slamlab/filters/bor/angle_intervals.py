"""Interval arithmetic of angles: (right, left), counter-clockwise from right to left.

right lies in (−π, π] and left in [right, right + 2π], so an interval over the seam at ±π is no
special case. MAK thesis 5.2.3 lists left first, 5.2.4 right first; here it is always right first.
"""

from math import atan2, pi

from slamlab.filters.bor.intervals import ROUNDING, width
from slamlab.geometry import wrap

FULL_CIRCLE = (pi, 3 * pi)
"""The interval of all directions [rad]."""


def angle_interval(right, left):
    """An interval of angles in normal form: wraps right into (−π, π].

    Parameters
    ----------
    right, left : float, right ≤ left as numbers [rad]

    Returns
    -------
    (right, left) [rad]; from a whole turn on all directions
    """
    if left - right >= 2 * pi:
        return FULL_CIRCLE
    start = wrap(float(right))
    return start, start + (left - right)


def angle_sum(a, b):
    """Sum of two intervals of angles, wrapped: all sums of an angle of a and one of b."""
    return angle_interval(a[0] + b[0], a[1] + b[1])


def contains(a, angle):
    """Whether an interval contains an angle (membership, wrapped). Equation (10.2)."""
    return (angle - a[0]) % (2 * pi) <= width(a)


def midpoint(a):
    """Midpoint (centre) of an interval of angles, wrapped [rad]."""
    return wrap((a[0] + a[1]) / 2)


def intersection(a, b):
    """Intersection of two intervals of angles: empty, one piece or two.

    Parameters
    ----------
    a, b : (right, left) [rad]

    Returns
    -------
    list of none to two (right, left), in order from a's right
    """
    pieces = []
    behind = (b[0] - a[0]) % (2 * pi)
    for start in (behind - 2 * pi, behind):  # b once round before, and where it is
        low, high = max(0.0, start), min(width(a), start + width(b))
        if low <= high:
            pieces.append(angle_interval(a[0] + low, a[0] + high))
    return pieces


def hull(pieces):
    """Interval hull: smallest interval of angles that holds one or two pieces, the gap included."""
    if len(pieces) == 1:
        return pieces[0]
    return min((_span(*pieces), _span(*reversed(pieces))), key=width)


def bearing_interval(origin, target):
    """Interval of the bearings from one box to another: from any point of it to any of the other.

    These are the directions of the differences, which fill a box themselves: seen from zero, it
    lies between two of its corners.

    Parameters
    ----------
    origin, target : (x_min, x_max, y_min, y_max) [m]

    Returns
    -------
    (right, left) [rad]; all directions where the boxes overlap or touch
    """
    x = target[0] - origin[1] - ROUNDING, target[1] - origin[0] + ROUNDING
    y = target[2] - origin[3] - ROUNDING, target[3] - origin[2] + ROUNDING
    if x[0] <= 0 <= x[1] and y[0] <= 0 <= y[1]:
        return FULL_CIRCLE
    centre = atan2(y[0] + y[1], x[0] + x[1])
    off = [wrap(atan2(v, u) - centre) for u in x for v in y]
    return angle_interval(centre + min(off), centre + max(off))


def _span(first, second):
    """Hull from the first piece's right, counter-clockwise, to the end of both."""
    behind = (second[0] - first[0]) % (2 * pi)
    return angle_interval(first[0], first[0] + max(width(first), behind + width(second)))


# names in the first edition
angles = angle_interval
bearings = bearing_interval
holds = contains
middle = midpoint
