"""Intervals (low, high) of numbers: all that a quantity may be, and what arithmetic makes of it.

Each result holds every value that some choice from the arguments gives, and none besides: it is
exact as long as no quantity enters a formula twice.
"""

from math import cos, pi, sin

ROUNDING = 1e-10
"""What is added outwards so that rounding never cuts off the truth [m] or [rad]."""


def add(a, b):
    """The sum: (a_low + b_low, a_high + b_high)."""
    return a[0] + b[0], a[1] + b[1]


def scaled(factor, a):
    """A number times an interval; a negative factor turns it round."""
    ends = factor * a[0], factor * a[1]
    return min(ends), max(ends)


def product(a, b):
    """The product: the smallest and the largest of the four products of the ends."""
    products = a[0] * b[0], a[0] * b[1], a[1] * b[0], a[1] * b[1]
    return min(products), max(products)


def around(middle, bound):
    """All within a bound of a number: (middle − bound, middle + bound)."""
    return middle - bound, middle + bound


def widened(a, by=ROUNDING):
    """The interval, pushed out at both ends."""
    return a[0] - by, a[1] + by


def width(a):
    """How wide: high − low."""
    return a[1] - a[0]


def cosine(a):
    """The cosine over an interval of angles: its extremes may lie inside, not at the ends.

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
        -1.0 if _meets(a, pi) else min(ends),
        1.0 if _meets(a, 0.0) else max(ends),
    )


def sine(a):
    """The sine over an interval of angles, see :func:`cosine`."""
    ends = sin(a[0]), sin(a[1])
    return (
        -1.0 if _meets(a, -pi / 2) else min(ends),
        1.0 if _meets(a, pi / 2) else max(ends),
    )


def chord(turn):
    """Chord over arc length, sin(Δθ/2) / (Δθ/2), over an interval of turns: it falls with |Δθ|.

    Parameters
    ----------
    turn : (low, high), within a whole turn either way [rad]

    Returns
    -------
    (low, high)

    Raises
    ------
    ValueError : a turn beyond that
    """
    most = max(abs(turn[0]), abs(turn[1]))
    least = 0.0 if turn[0] <= 0 <= turn[1] else min(abs(turn[0]), abs(turn[1]))
    if most > 2 * pi:
        raise ValueError(f"a step turns by up to {most:.1f} rad, more than once round: cut it")
    return _chord(most), _chord(least)


def _chord(turn):
    return sin(turn / 2) / (turn / 2) if turn else 1.0


def _meets(a, angle):
    """Whether an angle, or it and whole turns, lies in the interval."""
    return (angle - a[0]) % (2 * pi) <= a[1] - a[0]
