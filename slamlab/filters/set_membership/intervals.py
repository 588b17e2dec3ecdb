"""Interval arithmetic with outward rounding: (low, high), exact if each quantity occurs once."""

from math import cos, pi, sin

ROUNDING = 1e-10
"""Outward rounding: bounds are widened by this amount to cover rounding errors [m] or [rad]."""

MAX_SINC = 0.21724
"""Largest |sin(x) / x| for x ≥ π, at x = 4.49."""


def add(a, b):
    """Return the interval sum."""
    return a[0] + b[0], a[1] + b[1]


def scaled(factor, a):
    """Scale an interval by a number; a negative factor swaps its ends."""
    ends = factor * a[0], factor * a[1]
    return min(ends), max(ends)


def product(a, b):
    """Return the interval product: least and largest of the four end products. Equation (10.4)."""
    products = a[0] * b[0], a[0] * b[1], a[1] * b[0], a[1] * b[1]
    return min(products), max(products)


def around(middle, bound):
    """Return the interval of a midpoint ± an error bound."""
    return middle - bound, middle + bound


def widened(a, by=ROUNDING):
    """Widen an interval at both ends; the default is the outward rounding."""
    return a[0] - by, a[1] + by


def width(a):
    """Return high − low."""
    return a[1] - a[0]


def cosine(a):
    """Interval cosine: the maximum is 1 if a 2πk is inside, the minimum −1 if a π + 2πk is."""
    ends = cos(a[0]), cos(a[1])
    return (
        -1.0 if _contains_angle(a, pi) else min(ends),
        1.0 if _contains_angle(a, 0.0) else max(ends),
    )


def sine(a):
    """Return the interval sine; see :func:`cosine`."""
    ends = sin(a[0]), sin(a[1])
    return (
        -1.0 if _contains_angle(a, -pi / 2) else min(ends),
        1.0 if _contains_angle(a, pi / 2) else max(ends),
    )


def chord(turn):
    """Interval of chord / arc, sin(Δθ/2) / (Δθ/2); it is not the tightest beyond a full circle."""
    most = max(abs(turn[0]), abs(turn[1]))
    least = 0.0 if turn[0] <= 0 <= turn[1] else min(abs(turn[0]), abs(turn[1]))
    if most > 2 * pi:
        return -MAX_SINC, max(MAX_SINC, _chord_ratio(min(least, 2 * pi)))
    return _chord_ratio(most), _chord_ratio(least)


def _chord_ratio(turn):
    half = turn / 2  # also 0 for the smallest positive number
    return sin(half) / half if half else 1.0


def _contains_angle(a, angle):
    """Whether an interval contains an angle up to a multiple of 2π."""
    return (angle - a[0]) % (2 * pi) <= a[1] - a[0]
