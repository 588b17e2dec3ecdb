"""Prediction: bounds of the motion over the whole box and every noise (MAK thesis 5.2.4).

All robots drive alike here: a way w along heading + direction δ, and a turn τ. A steered robot, two
wheels and odometry say each in its own words which intervals w, δ and τ lie in.
"""

from math import atan2, hypot

from slamlab.filters.bor.angles import turned
from slamlab.filters.bor.intervals import (
    around,
    chord,
    cosine,
    product,
    scaled,
    sine,
    widened,
)


def moved(robot, heading, way, direction, turn):
    """Where a robot may be after a motion.

    x' = x + w cos(θ + δ),  y' = y + w sin(θ + δ),  θ' = θ + τ; every quantity stands once in each,
    so the bounds are the tightest there are.

    Parameters
    ----------
    robot : (x_min, x_max, y_min, y_max) [m]
    heading : (right, left) [rad]
    way : (low, high) w [m]
    direction, turn : (low, high) δ and τ [rad]

    Returns
    -------
    box (x_min, x_max, y_min, y_max) [m], heading (right, left) [rad]
    """
    course = heading[0] + direction[0], heading[1] + direction[1]
    dx, dy = widened(product(way, cosine(course))), widened(product(way, sine(course)))
    box = (robot[0] + dx[0], robot[1] + dx[1], robot[2] + dy[0], robot[3] + dy[1])
    return box, turned(heading, widened(turn))


def steered(V, gamma, B, T):
    """The motion of a steered robot in one period.

    w = T V,  δ = γ,  τ = T V / B · sin γ

    Parameters
    ----------
    V : (low, high), speed, noise included [m/s]
    gamma : (low, high), steering angle, noise included [rad]
    B : float, wheel base [m]
    T : float, period [s]

    Returns
    -------
    way, direction, turn : intervals for :func:`moved`

    Raises
    ------
    ValueError : a base or a period that is not above zero
    """
    if not (B > 0 and T > 0):
        raise ValueError(f"wheel base and period are above zero, not {B} and {T}")
    way = scaled(T, V)
    return way, gamma, scaled(1 / B, product(way, sine(gamma)))


def wheels(left, right, base):
    """The motion of two wheels: an arc of length (l + r)/2 that turns by (r − l)/b.

    Parameters
    ----------
    left, right : (low, high), ways of the wheels, noise included [m]
    base : float, distance of the wheels [m]

    Returns
    -------
    way, direction, turn : intervals for :func:`moved`

    Raises
    ------
    ValueError : a base that is not above zero, or more than a whole turn in a step
    """
    if not base > 0:
        raise ValueError(f"the distance of the wheels is above zero, not {base}")
    length = (left[0] + right[0]) / 2, (left[1] + right[1]) / 2
    return arc(length, ((right[0] - left[1]) / base, (right[1] - left[0]) / base))


def arc(length, turn):
    """The motion along an arc: its chord, which points half the turn off the old heading.

    Chord and direction both hold the turn, and intervals forget that it is the same one: this is
    sound, and a little wider than need be.

    Parameters
    ----------
    length : (low, high), of the arc [m]
    turn : (low, high) [rad]

    Returns
    -------
    way, direction, turn : intervals for :func:`moved`

    Raises
    ------
    ValueError : more than a whole turn in a step
    """
    return product(length, chord(turn)), scaled(0.5, turn), turn


def odometry(motion, length_bound, turn_bound):
    """The motion that odometry tells, an arc whose length and turn may be off.

    Parameters
    ----------
    motion : (3,) in the frame of the pose before [m, m, rad]
    length_bound : float, most that the arc's length is off [m]
    turn_bound : float, most that the turn is off [rad]

    Returns
    -------
    way, direction, turn : intervals for :func:`moved`
    """
    x, y, turn = (float(number) for number in motion)
    told = hypot(x, y)
    length = told / chord((turn, turn))[0]
    way, half, turns = arc(around(length, length_bound), around(turn, turn_bound))
    # what is no arc, such as a turn before the drive, points elsewhere by a known angle
    aside = atan2(y, x) - turn / 2 if told else 0.0
    return way, (half[0] + aside, half[1] + aside), turns
