"""Classic mistakes in A, J_xr and J_z: how the heading carries things along. With their hints."""

from functools import partial

import numpy as np

from slamlab.exercises.tasks.ex04_mistakes import DEGREE, matrix, mistake, sign_mistake


def _swing(angle, length):
    """What a point that far off in that direction does per radian of turn, (n, 2)."""
    return np.column_stack([-length * np.sin(angle), length * np.cos(angle)])


def _at_drive(angle, length=lambda d: d):
    """A's heading column with another angle or length."""

    def column(inputs):
        d, turn = inputs["u"].T
        return _swing(angle(inputs["x"][:, 2], turn), length(d))

    return column


def _at_sight(angle, length=lambda r: r):
    """J_xr's heading column with another angle or length."""

    def column(inputs):
        r, bearing = inputs["z"].T
        return _swing(angle(inputs["x"][:, 2], bearing), length(r))

    return column


def _polar(angle, length=lambda r: r):
    """J_z with another angle or length."""

    def matrices(inputs):
        r, bearing = inputs["z"].T
        phi = angle(inputs["x"][:, 2], bearing)
        (sx, sy), c, s = _swing(phi, length(r)).T, np.cos(phi), np.sin(phi)
        return matrix([[c, sx], [s, sy]])

    return matrices


def _A(inputs):
    sx, sy = _at_drive(_first)(inputs).T
    return matrix([[1, 0, sx], [0, 1, sy], [0, 0, 1]])


def _printed_5(inputs):
    theta, d = inputs["x"][:, 2], inputs["u"][:, 0]
    return np.column_stack([-d * np.sin(theta) ** 2, d * np.cos(theta) ** 2])


def _first(theta, _):
    return theta


def _sum(theta, other):
    return theta + other


COLUMN = np.s_[:2, 2]
DEGREES = (
    "Degrees and radians are mixed. Angles come in radians, np.sin and np.cos take radians, and a "
    "derivative by an angle is per radian."
)
SINE_COSINE = (
    "Sine and cosine have changed places. Take θ = 0 and look along x: which coordinate of the end "
    "point feels a small change of heading, x or y?"
)
COLUMN_SIGN = (
    "The heading column has a wrong sign. Take θ = 0 and look along x, then turn a little to the "
    "left: does the end point move to +y or to −y?"
)
IDENTITY = "The new x is the old x plus something. What is its derivative by the old x?"

A_ODOMETRY = (
    mistake(
        "transposed",
        "This is the transpose: a row per component of the new pose, a column per component of x.",
        lambda i: _A(i).transpose(0, 2, 1),
    ),
    mistake("identity-missing", IDENTITY, lambda i: np.zeros(2), part=np.s_[[0, 1], [0, 1]]),
    mistake(
        "printed-5",
        "This is Smolec's (5) as printed, and it turns the step twice: Δx = d cos θ holds the "
        "cosine "
        "already. "
        "Write f out in d and θ, then differentiate.",
        _printed_5,
        part=COLUMN,
    ),
    mistake(
        "step-missing",
        "The distance is missing, as in Smolec's (4). The farther the robot drives, the more "
        "a heading error moves its end point.",
        _at_drive(_first, np.ones_like),
        part=COLUMN,
    ),
    mistake(
        "after-motion",
        "The Jacobian was taken at another heading. Look at f_odometry: does it drive before or "
        "after it turns?",
        _at_drive(_sum),
        _at_drive(lambda theta, turn: theta + turn / 2),
        part=COLUMN,
    ),
    mistake(
        "degrees",
        DEGREES,
        _at_drive(lambda theta, _: theta * DEGREE),
        _at_drive(lambda theta, _: theta / DEGREE),
        _at_drive(_first, lambda d: d * DEGREE),
        _at_drive(_first, lambda d: d / DEGREE),
        part=COLUMN,
    ),
    mistake(
        "sine-cosine",
        SINE_COSINE,
        lambda i: _at_drive(_first)(i)[:, ::-1],
        part=COLUMN,
        sizes_only=True,
    ),
    mistake(
        "no-heading",
        "A = I says that the old heading does not matter to where the robot ends. Look at "
        "f_odometry: "
        "do x and y contain θ?",
        lambda i: np.zeros(2),
        part=COLUMN,
    ),
    sign_mistake("column-sign", COLUMN_SIGN, _at_drive(_first), part=COLUMN),
    mistake(
        "turn-for-one",
        "The last entry: by what does the new heading change when the old one changes by a little? "
        "Δθ comes from the wheels, it is no function of x.",
        lambda i: i["u"][:, 1],
        lambda i: np.zeros(1),
        part=np.s_[2, 2],
    ),
)

_in_J_xr = partial(mistake, part=COLUMN, output="J_xr")
_in_J_z = partial(mistake, output="J_z")

J_XR = (
    _in_J_xr(
        "printed-10",
        "J_xr as printed in Smolec's (10): neither range nor bearing is in it. Does a turn of "
        "the robot "
        "move "
        "a landmark at 8 m as little as one at 1 m?",
        _at_sight(_first, np.ones_like),
    ),
    _in_J_xr(
        "jxr-range-missing",
        "J_xr without the range: a small turn would move a landmark at 8 m as little as one at "
        "1 m.",
        _at_sight(_sum, np.ones_like),
    ),
    _in_J_xr(
        "jxr-bearing-missing",
        "J_xr without the bearing: this landmark would lie straight ahead of the robot. In which "
        "direction does the beam leave?",
        _at_sight(_first),
    ),
    _in_J_xr(
        "jxr-bearing-sign",
        "The sign of the bearing in J_xr: bearings count counter-clockwise from the heading.",
        _at_sight(lambda theta, bearing: theta - bearing),
    ),
    _in_J_xr(
        "jxr-degrees",
        DEGREES,
        _at_sight(lambda theta, bearing: (theta + bearing) * DEGREE),
        _at_sight(lambda theta, bearing: (theta + bearing) / DEGREE),
        _at_sight(lambda theta, bearing: theta + bearing * DEGREE),
        _at_sight(lambda theta, bearing: theta + bearing / DEGREE),
        _at_sight(_sum, lambda r: r * DEGREE),
        _at_sight(_sum, lambda r: r / DEGREE),
    ),
    _in_J_xr(
        "jxr-sine-cosine",
        SINE_COSINE,
        lambda i: _at_sight(_sum)(i)[:, ::-1],
        sizes_only=True,
    ),
    _in_J_xr(
        "jxr-no-heading",
        "The heading column of J_xr is empty: turn the robot while its beam holds a landmark. "
        "Does the place it points at stay?",
        lambda i: np.zeros(2),
    ),
    sign_mistake("jxr-sign", COLUMN_SIGN, _at_sight(_sum), COLUMN, "J_xr"),
    _in_J_xr(
        "jxr-identity-missing",
        IDENTITY,
        lambda i: np.zeros((2, 2)),
        part=np.s_[:, :2],
    ),
)

J_Z = (
    _in_J_z(
        "printed-11",
        "J_z as printed in Smolec's (11) is a pure rotation. Look at the units of its second "
        "column: metres "
        "of landmark per radian of bearing. Where do the metres come from?",
        _polar(_sum, np.ones_like),
        _polar(_first, np.ones_like),
    ),
    _in_J_z(
        "jz-transposed",
        "This is the transpose of J_z: a row per coordinate of the landmark, a column per "
        "component "
        "of z.",
        lambda i: _polar(_sum)(i).transpose(0, 2, 1),
    ),
    _in_J_z(
        "jz-columns-swapped",
        "The columns of J_z have changed places: z is range first, bearing second.",
        lambda i: _polar(_sum)(i)[:, :, ::-1],
    ),
    _in_J_z(
        "jz-bearing-missing",
        "J_z without the bearing: in which direction does the beam leave the robot?",
        _polar(_first),
    ),
    _in_J_z(
        "jz-heading-missing",
        "J_z without the heading: this is the landmark in the robot's frame. g gives it in the "
        "world's.",
        _polar(lambda _, bearing: bearing),
    ),
    _in_J_z(
        "jz-bearing-sign",
        "The sign of the bearing in J_z: bearings count counter-clockwise from the heading.",
        _polar(lambda theta, bearing: theta - bearing),
    ),
    _in_J_z(
        "jz-degrees",
        DEGREES,
        _polar(lambda theta, bearing: (theta + bearing) * DEGREE),
        _polar(lambda theta, bearing: (theta + bearing) / DEGREE),
        _polar(lambda theta, bearing: theta + bearing * DEGREE),
        _polar(lambda theta, bearing: theta + bearing / DEGREE),
        _polar(_sum, lambda r: r * DEGREE),
        _polar(_sum, lambda r: r / DEGREE),
    ),
    _in_J_z(
        "jz-sine-cosine",
        SINE_COSINE,
        lambda i: _polar(lambda theta, bearing: np.pi / 2 - theta - bearing)(i),
        sizes_only=True,
    ),
    sign_mistake(
        "jz-sign",
        "Every entry of J_z has the right size, and a sign is wrong. Take θ + β = 0: the beam "
        "points "
        "along x. What does a longer range do, what a larger bearing?",
        _polar(_sum),
        output="J_z",
    ),
)
