"""Interval motion model (prediction): w [m] along heading + δ, and a turn τ [rad] (MAK 5.2.4)."""

from math import atan2, hypot

from slamlab.filters.set_membership.angle_intervals import angle_sum
from slamlab.filters.set_membership.intervals import (
    around,
    chord,
    cosine,
    product,
    scaled,
    sine,
    widened,
)


def predict_box(robot, heading, distance, direction, turn):
    """Predict the tightest box and heading of the robot after a motion. Equation (10.3).

    x' = x + w cos(θ + δ),  y' = y + w sin(θ + δ),  θ' = θ + τ
    """
    course = heading[0] + direction[0], heading[1] + direction[1]
    dx, dy = widened(product(distance, cosine(course))), widened(product(distance, sine(course)))
    box = (robot[0] + dx[0], robot[1] + dx[1], robot[2] + dy[0], robot[3] + dy[1])
    return box, angle_sum(heading, widened(turn))


def steered(V, gamma, B, T):
    """Return w, δ, τ of a steered (car-like) robot: w = T V, δ = γ, τ = T V / B · sin γ."""
    if not (B > 0 and T > 0):
        raise ValueError(f"wheel base and period must be above zero, not {B} and {T}")
    distance = scaled(T, V)
    return distance, gamma, scaled(1 / B, product(distance, sine(gamma)))


def wheels(left, right, base):
    """Return w, δ, τ of a differential drive: arc of length (l + r)/2, turn (r − l)/b [m, rad]."""
    if not base > 0:
        raise ValueError(f"the distance between the wheels must be above zero, not {base}")
    length = (left[0] + right[0]) / 2, (left[1] + right[1]) / 2
    return arc(length, ((right[0] - left[1]) / base, (right[1] - left[0]) / base))


def arc(length, turn):
    """Return w, δ, τ of an arc's chord at half the turn; not tight, because both depend on τ."""
    return product(length, chord(turn)), scaled(0.5, turn), turn


def odometry(motion, length_bound, turn_bound):
    """Return w, δ, τ of an odometry increment (3,), an arc whose length and turn have bounds."""
    x, y, turn = (float(number) for number in motion)
    chord_length = hypot(x, y)
    length = chord_length / chord((turn, turn))[0]
    distance, half, turns = arc(around(length, length_bound), around(turn, turn_bound))
    # an increment that is no arc, such as a turn before a straight line, has a known deviation
    deviation = atan2(y, x) - turn / 2 if chord_length else 0.0
    return distance, (half[0] + deviation, half[1] + deviation), turns
