"""Intervals of angles (right, left): what is met going counter-clockwise from right to left.

right lies in (−π, π] and left in [right, right + 2π], so an interval over the seam at ±π is no
special case. MAK thesis 5.2.3 lists left first, 5.2.4 right first; here it is always right first.
"""

from math import atan2, pi

from slamlab.filters.bor.intervals import ROUNDING, width
from slamlab.geometry import wrap

WHOLE = (pi, 3 * pi)
"""Every direction."""


def angles(right, left):
    """An interval of angles, brought to its one form.

    Parameters
    ----------
    right, left : float, right ≤ left as numbers [rad]

    Returns
    -------
    (right, left) [rad]; from a whole turn on all directions
    """
    if left - right >= 2 * pi:
        return WHOLE
    start = wrap(float(right))
    return start, start + (left - right)


def turned(a, b):
    """All sums of an angle of a and one of b."""
    return angles(a[0] + b[0], a[1] + b[1])


def holds(a, angle):
    """Whether an angle lies in the interval."""
    return (angle - a[0]) % (2 * pi) <= width(a)


def middle(a):
    """The angle half-way from right to left, wrapped [rad]."""
    return wrap((a[0] + a[1]) / 2)


def intersection(a, b):
    """What two intervals of angles have in common: nothing, one piece or two.

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
            pieces.append(angles(a[0] + low, a[0] + high))
    return pieces


def enclosing(pieces):
    """The smallest interval that holds one or two pieces: the gap it spans is the smaller one."""
    if len(pieces) == 1:
        return pieces[0]
    return min((_spanned(*pieces), _spanned(*reversed(pieces))), key=width)


def bearings(origin, target):
    """Every direction in which some point of one box sees some point of another.

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
        return WHOLE
    centre = atan2(y[0] + y[1], x[0] + x[1])
    off = [wrap(atan2(v, u) - centre) for u in x for v in y]
    return angles(centre + min(off), centre + max(off))


def _spanned(first, second):
    """From the first piece's right, counter-clockwise, until both have been passed."""
    behind = (second[0] - first[0]) % (2 * pi)
    return angles(first[0], first[0] + max(width(first), behind + width(second)))
