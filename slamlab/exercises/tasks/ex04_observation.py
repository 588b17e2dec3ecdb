"""Classic mistakes in H, the Jacobian of range and bearing, each with its hint."""

import numpy as np

from slamlab.exercises.tasks.ex04_mistakes import DEGREE, matrix, mistake, sign_mistake


def _offsets(inputs):
    """dx, dy from robot to landmark, range r and its square q; (n,) each."""
    dx, dy = (inputs["p"] - inputs["x"][:, :2]).T
    q = dx**2 + dy**2
    return dx, dy, np.sqrt(q), q


def _by_landmark(inputs):
    dx, dy, r, q = _offsets(inputs)
    return matrix([[dx / r, dy / r], [-dy / q, dx / q]])


def _by_robot(inputs):
    dx, dy, r, q = _offsets(inputs)
    return matrix([[-dx / r, -dy / r, 0], [dy / q, -dx / q, -1]])


def _exchanged(inputs):
    dx, dy, r, q = _offsets(inputs)
    return matrix([[dy / r, dx / r], [dx / q, dy / q]])


def _bearing_over_r(inputs):
    dx, dy, r, _ = _offsets(inputs)
    return np.column_stack([dy / r, dx / r])


def _range_over_r2(inputs):
    dx, dy, _, q = _offsets(inputs)
    return np.column_stack([dx / q, dy / q])


def _dx_over_q(inputs):
    dx, _, _, q = _offsets(inputs)
    return dx / q


EXCHANGED = (
    "dx and dy have changed places. Test your H on a landmark straight ahead of a robot with θ "
    "= 0: "
    "what does one step towards it do to the range, and what to the bearing?"
)
R_FOR_R2 = (
    "The bearing row has the wrong power of r. Look at its unit: radians per metre. "
    "dx is in metres; by what must it be divided?"
)
R2_FOR_R = (
    "The range row has the wrong power of r. Metres of range per metre of motion have no unit: "
    "look at what dx is divided by."
)
BEARING_DEGREES = (
    "The bearing row is in degrees. A derivative of atan2 is in radians, and so are all angles "
    "here."
)
ROWS = "The rows have changed places: z is range first, bearing second."

H_ROBOT = (
    mistake("rows-swapped", ROWS, lambda i: _by_robot(i)[:, ::-1]),
    mistake(
        "by-landmark",
        "All position entries have the wrong sign: this is what happens when the landmark moves. "
        "Here the robot moves: does a step towards the landmark make the range grow?",
        _by_landmark,
        part=np.s_[:, :2],
    ),
    mistake("xy-exchanged", EXCHANGED, _exchanged, part=np.s_[:, :2], sizes_only=True),
    mistake("r-for-r2", R_FOR_R2, _bearing_over_r, part=np.s_[1, :2], sizes_only=True),
    mistake("r2-for-r", R2_FOR_R, _range_over_r2, part=np.s_[0, :2], sizes_only=True),
    mistake(
        "degrees",
        BEARING_DEGREES,
        lambda i: _by_robot(i)[:, 1, :2] / DEGREE,
        part=np.s_[1, :2],
    ),
    mistake(
        "heading-degrees",
        "The heading column changes per radian of heading, not per degree: no factor belongs "
        "there.",
        lambda i: np.array(-DEGREE),
        lambda i: np.array(-1 / DEGREE),
        part=np.s_[1, 2],
    ),
    mistake(
        "bearing-sign",
        "The bearing row has the wrong sign: bearings count counter-clockwise. The landmark is "
        "ahead "
        "and the robot steps to its left: on which side is the landmark now?",
        lambda i: -_by_robot(i)[:, 1, :2],
        part=np.s_[1, :2],
    ),
    mistake(
        "printed-2",
        "One sign is wrong, the one that Smolec's (2) prints wrongly: the bearing row's second "
        "entry. Robot at the origin, landmark at (1, 0): a step along +y, and the bearing "
        "becomes …?",
        _dx_over_q,
        part=np.s_[1, 1],
    ),
    mistake(
        "heading-missing",
        "The bearing does not change with the heading in your H. Turn the robot left on the spot: "
        "what happens to the bearing of a landmark?",
        lambda i: np.array(0.0),
        part=np.s_[1, 2],
    ),
    mistake(
        "heading-sign",
        "The sign of the heading's entry: the robot turns left, and the landmark drifts to its "
        "right.",
        lambda i: np.array(1.0),
        part=np.s_[1, 2],
    ),
    sign_mistake(
        "sign",
        "Every entry has the right size, and a sign is wrong. Move the robot a little along "
        "+x, then "
        "along +y, and think through whether range and bearing grow or shrink.",
        _by_robot,
    ),
)

H_LANDMARK = (
    mistake(
        "by-robot",
        "This is what happens when the robot moves. Here the landmark moves: does a step of the "
        "landmark away from the robot make the range grow or shrink?",
        lambda i: -_by_landmark(i),
    ),
    mistake(
        "transposed",
        "This is the transpose: one row per component of z, one column per component of p.",
        lambda i: _by_landmark(i).transpose(0, 2, 1),
    ),
    mistake("rows-swapped", ROWS, lambda i: _by_landmark(i)[:, ::-1]),
    mistake("xy-exchanged", EXCHANGED, _exchanged, sizes_only=True),
    mistake("r-for-r2", R_FOR_R2, _bearing_over_r, part=np.s_[1], sizes_only=True),
    mistake("r2-for-r", R2_FOR_R, _range_over_r2, part=np.s_[0], sizes_only=True),
    mistake("degrees", BEARING_DEGREES, lambda i: _by_landmark(i)[:, 1] / DEGREE, part=np.s_[1]),
    mistake(
        "bearing-sign",
        "The bearing row has the wrong sign: bearings count counter-clockwise. The landmark is "
        "straight ahead and moves to the robot's left: does its bearing grow or shrink?",
        lambda i: -_by_landmark(i)[:, 1],
        part=np.s_[1],
    ),
    mistake(
        "printed-3",
        "One sign is wrong: the one that Smolec's (3) inherits from (2). Robot at the "
        "origin, landmark at (1, 0): the landmark moves along +y, and its bearing becomes …?",
        lambda i: -_dx_over_q(i),
        part=np.s_[1, 1],
    ),
    sign_mistake(
        "sign",
        "Every entry has the right size, and a sign is wrong. Move the landmark a little along +x, "
        "then along +y, and think through whether range and bearing grow or shrink.",
        _by_landmark,
    ),
)
