"""Classic mistakes in the covariance of a new landmark, each with its hint.

They are recognised with the right Jacobians: the task needs those solved.
"""

import numpy as np

from slamlab.exercises.tasks.ex04_mistakes import mistake
from slamlab.models import jacobians


def _jacobians(inputs):
    pairs = list(zip(inputs["x"], inputs["z"], strict=True))
    return (
        np.array([jacobians.J_xr(x, z) for x, z in pairs]),
        np.array([jacobians.J_z(x, z) for x, z in pairs]),
    )


def _spread(J, C):
    return J @ C @ J.transpose(0, 2, 1)


def _from_pose(inputs):
    return _spread(_jacobians(inputs)[0], inputs["P"])


def _from_measurement(inputs, R=None):
    return _spread(_jacobians(inputs)[1], inputs["R"] if R is None else R)


def _cross(inputs):
    return inputs["P"] @ _jacobians(inputs)[0].transpose(0, 2, 1)


def _sigmas(inputs):
    return np.sqrt(inputs["R"])


def _swapped(inputs):
    return inputs["R"][:, ::-1, ::-1]


def _J_z_transposed(inputs):
    J_z = _jacobians(inputs)[1]
    return _from_pose(inputs) + J_z.transpose(0, 2, 1) @ inputs["R"] @ J_z


P_NN = (
    mistake(
        "pose-ignored",
        "P_nn holds the measurement's noise only. Nobody knows exactly where the robot stood "
        "when it "
        "measured: what carries that doubt over to the landmark?",
        _from_measurement,
        output="P_nn",
    ),
    mistake(
        "noise-ignored",
        "P_nn holds the pose's uncertainty only: the measurement is noisy too, and R says how "
        "much.",
        _from_pose,
        output="P_nn",
    ),
    mistake(
        "noise-not-carried",
        "R is added as it is, but it is in range and bearing while P_nn is in x and y. Look at the "
        "units: what turns one into the other?",
        lambda i: _from_pose(i) + i["R"],
        lambda i: i["P"][:, :2, :2] + i["R"],
        lambda i: i["R"],
        output="P_nn",
    ),
    mistake(
        "heading-ignored",
        "The pose's position is in P_nn, its heading is not: a robot that is unsure of its heading "
        "is unsure of everything it sees far away. Look at which block of P you use.",
        lambda i: i["P"][:, :2, :2] + _from_measurement(i),
        output="P_nn",
    ),
    mistake(
        "standard-deviation",
        "R's diagonal holds variances already: look whether you take a root or a square of it.",
        lambda i: _from_pose(i) + _from_measurement(i, _sigmas(i)),
        lambda i: _from_pose(i) + _from_measurement(i, i["R"] @ i["R"]),
        output="P_nn",
    ),
    mistake(
        "sandwich-reversed",
        "J_zᵀ R J_z has the shape of J_z R J_zᵀ, and another meaning. R must be multiplied by the "
        "side of J_z that is made for range and bearing: which of its sides is that?",
        _J_z_transposed,
        output="P_nn",
    ),
    mistake(
        "transpose-missing",
        "A covariance has a Jacobian on either side, and the right one is transposed. Is your P_nn "
        "symmetric?",
        lambda i: _from_pose(i) + _jacobians(i)[1] @ i["R"] @ _jacobians(i)[1],
        lambda i: _from_pose(i) + _jacobians(i)[1] @ i["R"],
        output="P_nn",
    ),
    mistake(
        "noise-subtracted",
        "Two independent doubts add up, they do not cancel: look at the sign between the two "
        "terms.",
        lambda i: _from_pose(i) - _from_measurement(i),
        output="P_nn",
    ),
)

P_RN = (
    mistake(
        "cross-zero",
        "P_rn is zero: this says that robot and landmark err independently. But the landmark was "
        "placed from the robot's pose: had the robot stood 1 m farther left, where would it be?",
        lambda i: np.zeros((3, 2)),
        output="P_rn",
    ),
    mistake(
        "cross-without-heading",
        "P_rn takes over the position's share only: a heading error moves the new landmark as "
        "well. "
        "Look at which Jacobian says by how much.",
        lambda i: i["P"][:, :, :2],
        output="P_rn",
    ),
    mistake(
        "cross-sign",
        "P_rn has the wrong sign: where the robot errs to the right, so does its landmark.",
        lambda i: -_cross(i),
        output="P_rn",
    ),
    mistake(
        "cross-not-weighted",
        "P_rn is the bare Jacobian. How far the two err together also depends on how far the robot "
        "errs at all: where is P?",
        lambda i: _jacobians(i)[0].transpose(0, 2, 1),
        output="P_rn",
    ),
)
