"""Angle intervals, interval arithmetic of angles: (right, left) [rad], counter-clockwise, right
in (−π, π].

The MAK thesis lists left first in 5.2.3, and right first in 5.2.4.
"""

from math import atan2, pi

from slamlab.filters.set_membership.intervals import ROUNDING, width
from slamlab.geometry import wrap

FULL_CIRCLE = (pi, 3 * pi)
"""The interval of all directions [rad]."""


def angle_interval(right, left):
    """Create an interval of angles, right wrapped to (−π, π]; FULL_CIRCLE if it has 2π or more."""
    if left - right >= 2 * pi:
        return FULL_CIRCLE
    start = wrap(float(right))
    return start, start + (left - right)


def angle_sum(a, b):
    """Return the interval of the sums of an angle in a and an angle in b."""
    return angle_interval(a[0] + b[0], a[1] + b[1])


def contains(a, angle):
    """Whether an interval contains an angle or the angle ± 2πk (membership). Equation (10.2)."""
    return (angle - a[0]) % (2 * pi) <= width(a)


def midpoint(a):
    """Return the midpoint (centre) of an interval of angles, wrapped [rad]."""
    return wrap((a[0] + a[1]) / 2)


def intersection(a, b):
    """Intersect two intervals of angles; return at most two pieces, ordered from a's right."""
    pieces = []
    behind = (b[0] - a[0]) % (2 * pi)
    for start in (behind - 2 * pi, behind):  # b, and b a full circle earlier
        low, high = max(0.0, start), min(width(a), start + width(b))
        if low <= high:
            pieces.append(angle_interval(a[0] + low, a[0] + high))
    return pieces


def hull(pieces):
    """Return the interval hull: the smallest interval of angles that contains one or two pieces."""
    if len(pieces) == 1:
        return pieces[0]
    return min((_span(*pieces), _span(*reversed(pieces))), key=width)


def bearing_interval(origin, target):
    """Return the bearings from points of one box to points of another; all if the boxes touch."""
    x = target[0] - origin[1] - ROUNDING, target[1] - origin[0] + ROUNDING
    y = target[2] - origin[3] - ROUNDING, target[3] - origin[2] + ROUNDING
    if x[0] <= 0 <= x[1] and y[0] <= 0 <= y[1]:
        return FULL_CIRCLE
    centre = atan2(y[0] + y[1], x[0] + x[1])
    off = [wrap(atan2(v, u) - centre) for u in x for v in y]
    return angle_interval(centre + min(off), centre + max(off))


def _span(first, second):
    """Return the hull that begins at the first piece's right and includes both pieces."""
    behind = (second[0] - first[0]) % (2 * pi)
    return angle_interval(first[0], first[0] + max(width(first), behind + width(second)))
