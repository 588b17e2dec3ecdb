"""Interval arithmetic: intervals (low, high) of all values that a quantity may take.

Each result holds every value that some choice from the arguments gives, and none besides: it is
exact as long as no quantity enters a formula twice.
"""

from math import cos, pi, sin

ROUNDING = 1e-10
"""Outward rounding: what bounds are widened by against rounding errors [m] or [rad]."""

SWING = 0.21724
"""What sin(x) / x is at most, up or down, beyond the first time round: its least value, at 4.49."""


def add(a, b):
    """Interval sum: (a_low + b_low, a_high + b_high)."""
    return a[0] + b[0], a[1] + b[1]


def scaled(factor, a):
    """Interval scaled by a number; a negative factor swaps its ends."""
    ends = factor * a[0], factor * a[1]
    return min(ends), max(ends)


def product(a, b):
    """Interval product: the smallest, the largest of the ends' four products. Equation (10.4)."""
    products = a[0] * b[0], a[0] * b[1], a[1] * b[0], a[1] * b[1]
    return min(products), max(products)


def around(middle, bound):
    """Interval from midpoint and error bound: (middle − bound, middle + bound)."""
    return middle - bound, middle + bound


def widened(a, by=ROUNDING):
    """Interval widened (inflated) at both ends, by default by the outward rounding."""
    return a[0] - by, a[1] + by


def width(a):
    """Width of an interval: high − low."""
    return a[1] - a[0]


def cosine(a):
    """Interval cosine: the range of cos over an interval; its extremes may lie inside.

    1 where a multiple of 2π lies inside, −1 where π and whole turns do, else the larger and the
    smaller of cos low and cos high.

    Parameters
    ----------
    a : (low, high), of any width [rad]

    Returns
    -------
    (low, high)
    """
    ends = cos(a[0]), cos(a[1])
    return (
        -1.0 if _contains_angle(a, pi) else min(ends),
        1.0 if _contains_angle(a, 0.0) else max(ends),
    )


def sine(a):
    """Interval sine: the range of sin over an interval, see :func:`cosine`."""
    ends = sin(a[0]), sin(a[1])
    return (
        -1.0 if _contains_angle(a, -pi / 2) else min(ends),
        1.0 if _contains_angle(a, pi / 2) else max(ends),
    )


def chord(turn):
    """Interval of chord over arc length, sin(Δθ/2) / (Δθ/2), which falls with |Δθ|.

    Parameters
    ----------
    turn : (low, high); beyond a whole turn either way the bounds are not the tightest [rad]

    Returns
    -------
    (low, high)
    """
    most = max(abs(turn[0]), abs(turn[1]))
    least = 0.0 if turn[0] <= 0 <= turn[1] else min(abs(turn[0]), abs(turn[1]))
    if most > 2 * pi:
        return -SWING, max(SWING, _chord_ratio(min(least, 2 * pi)))
    return _chord_ratio(most), _chord_ratio(least)


def _chord_ratio(turn):
    half = turn / 2  # 0 for the smallest of numbers, too
    return sin(half) / half if half else 1.0


def _contains_angle(a, angle):
    """Whether an interval contains an angle, or the angle and whole turns."""
    return (angle - a[0]) % (2 * pi) <= a[1] - a[0]
