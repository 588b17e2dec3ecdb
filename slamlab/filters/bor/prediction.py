"""Interval prediction (motion model): bounds over box and every noise (MAK thesis 5.2.4).

All robots move alike here: a distance w along heading + direction δ, and a turn τ. Steered robot,
differential drive and odometry each give the intervals that w, δ and τ lie in.
"""

from math import atan2, hypot

from slamlab.filters.bor.angle_intervals import angle_sum
from slamlab.filters.bor.intervals import (
    around,
    chord,
    cosine,
    product,
    scaled,
    sine,
    widened,
)


def predict_box(robot, heading, distance, direction, turn):
    """Prediction of the robot's box and heading by the motion model.

    x' = x + w cos(θ + δ),  y' = y + w sin(θ + δ),  θ' = θ + τ; every quantity stands once in each,
    so the bounds are the tightest there are. Equation (10.3).

    Parameters
    ----------
    robot : (x_min, x_max, y_min, y_max) [m]
    heading : (right, left) [rad]
    distance : (low, high) w [m]
    direction, turn : (low, high) δ and τ [rad]

    Returns
    -------
    box (x_min, x_max, y_min, y_max) [m], heading (right, left) [rad]
    """
    course = heading[0] + direction[0], heading[1] + direction[1]
    dx, dy = widened(product(distance, cosine(course))), widened(product(distance, sine(course)))
    box = (robot[0] + dx[0], robot[1] + dx[1], robot[2] + dy[0], robot[3] + dy[1])
    return box, angle_sum(heading, widened(turn))


def steered(V, gamma, B, T):
    """Motion intervals of a steered (car-like) robot in one period.

    w = T V,  δ = γ,  τ = T V / B · sin γ

    Parameters
    ----------
    V : (low, high), speed, noise included [m/s]
    gamma : (low, high), steering angle, noise included [rad]
    B : float, wheel base [m]
    T : float, period [s]

    Returns
    -------
    distance, direction, turn : intervals for :func:`predict_box`

    Raises
    ------
    ValueError : a base or a period that is not above zero
    """
    if not (B > 0 and T > 0):
        raise ValueError(f"wheel base and period are above zero, not {B} and {T}")
    distance = scaled(T, V)
    return distance, gamma, scaled(1 / B, product(distance, sine(gamma)))


def wheels(left, right, base):
    """Motion intervals of a differential drive: an arc of length (l + r)/2, turn (r − l)/b.

    Parameters
    ----------
    left, right : (low, high), distances rolled by the wheels, noise included [m]
    base : float, distance of the wheels [m]

    Returns
    -------
    distance, direction, turn : intervals for :func:`predict_box`

    Raises
    ------
    ValueError : a base that is not above zero, or more than a whole turn in a step
    """
    if not base > 0:
        raise ValueError(f"the distance of the wheels is above zero, not {base}")
    length = (left[0] + right[0]) / 2, (left[1] + right[1]) / 2
    return arc(length, ((right[0] - left[1]) / base, (right[1] - left[0]) / base))


def arc(length, turn):
    """Motion intervals of an arc: its chord, which points half the turn off the old heading.

    Chord and direction both hold the turn, and intervals forget that it is the same one: this is
    sound, and a little wider than need be.

    Parameters
    ----------
    length : (low, high), of the arc [m]
    turn : (low, high) [rad]

    Returns
    -------
    distance, direction, turn : intervals for :func:`predict_box`

    Raises
    ------
    ValueError : more than a whole turn in a step
    """
    return product(length, chord(turn)), scaled(0.5, turn), turn


def odometry(motion, length_bound, turn_bound):
    """Motion intervals of an odometry increment, an arc with bounded errors of length and turn.

    Parameters
    ----------
    motion : (3,) odometry increment in the frame of the pose before [m, m, rad]
    length_bound : float, error bound of the arc's length [m]
    turn_bound : float, error bound of the turn [rad]

    Returns
    -------
    distance, direction, turn : intervals for :func:`predict_box`
    """
    x, y, turn = (float(number) for number in motion)
    chord_length = hypot(x, y)
    length = chord_length / chord((turn, turn))[0]
    distance, half, turns = arc(around(length, length_bound), around(turn, turn_bound))
    # what is no arc, such as a turn before the drive, points elsewhere by a known angle
    aside = atan2(y, x) - turn / 2 if chord_length else 0.0
    return distance, (half[0] + aside, half[1] + aside), turns


moved = predict_box  # name in the first edition
