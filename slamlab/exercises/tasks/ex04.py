"""Exercise 04, Models and Jacobians: H, A, J_xr, J_z, and what they are for."""

import numpy as np

from slamlab.exercises.drives.ex04 import DRIVES
from slamlab.exercises.exercise import Exercise
from slamlab.exercises.law import Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex04_covariance import P_NN, P_RN
from slamlab.exercises.tasks.ex04_laws import agree, by_landmark, by_pose, by_robot, close, new_by_measurement, new_by_robot
from slamlab.exercises.tasks.ex04_motion import A_ODOMETRY, J_XR, J_Z
from slamlab.exercises.tasks.ex04_observation import H_LANDMARK, H_ROBOT

ROWS = 24
POSE, LANDMARK = slice(0, 3), slice(3, 5)


def _poses(rng):
    return np.column_stack([rng.uniform(-5, 5, (ROWS, 2)), rng.uniform(-np.pi, np.pi, ROWS)])


def _measurements(rng):
    return np.column_stack([rng.uniform(1.2, 8, ROWS), rng.uniform(-np.pi, np.pi, ROWS)])


def _pose_and_landmark(rng):
    x, direction = _poses(rng), rng.uniform(-np.pi, np.pi, ROWS)
    offset = np.column_stack([np.cos(direction), np.sin(direction)])
    return {"x": x, "p": x[:, :2] + rng.uniform(0.5, 8, (ROWS, 1)) * offset}


def _pose_and_control(rng):
    u = np.column_stack([rng.uniform(0.2, 3, ROWS), rng.uniform(-1, 1, ROWS)])
    return {"x": _poses(rng), "u": u}


def _pose_and_measurement(rng):
    return {"x": _poses(rng), "z": _measurements(rng)}


def _belief_and_measurement(rng):
    sigma = np.column_stack([rng.uniform(0.03, 0.15, (ROWS, 2)), rng.uniform(0.01, 0.05, ROWS)])
    roots = rng.standard_normal((ROWS, 3, 6))
    P = roots @ roots.transpose(0, 2, 1)
    unit = np.sqrt(np.diagonal(P, axis1=1, axis2=2))
    P *= (sigma / unit)[:, :, None] * (sigma / unit)[:, None, :]
    variances = np.column_stack([rng.uniform(0.02, 0.1, ROWS), rng.uniform(0.01, 0.03, ROWS)]) ** 2
    return {
        "x": _poses(rng),
        "P": P,
        "z": _measurements(rng),
        "R": variances[:, :, None] * np.eye(2),
    }


def _difference(name, points, says, derivative, part, output="result"):
    """A law: a part of a Jacobian equals differences of the model."""

    def holds(inputs, outputs):
        return close(outputs[output][:, *part], derivative(inputs)[:, *part])

    return Law(name, points, says, holds)


def _covariance(name, points, says, rows, columns):
    """A law: a block of the covariance equals that of samples."""
    return Law(name, points, says, lambda i, o: agree(o[name], (rows, columns), i))


RANGE_ROW, BEARING_ROW = np.s_[0, :], np.s_[1, :]

EXERCISE = Exercise(
    id="04",
    notebook="04_models_and_jacobians",
    title="Models and Jacobians",
    drives="slamlab.exercises.drives.ex04",
    allows=(
        "slamlab.models.motion",
        "slamlab.models.observation",
        "slamlab.geometry",
        "slamlab.views",
        "slamlab.layers",
    ),
    answers=("slamlab.models.jacobians", "slamlab.models.symbolic"),
    tasks=(
        Task(
            id="04-h-robot",
            title="H, the robot's part",
            drive=DRIVES["04-h-robot"],
            inputs=_pose_and_landmark,
            shapes={"result": (2, 3)},
            laws=(
                _difference(
                    "range-row",
                    1,
                    "the first row is how the range of h changes with x, y, θ",
                    by_robot,
                    RANGE_ROW,
                ),
                _difference(
                    "bearing-row",
                    2,
                    "the second row is how the bearing of h changes with x, y, θ",
                    by_robot,
                    BEARING_ROW,
                ),
            ),
            diagnoses=H_ROBOT,
        ),
        Task(
            id="04-h-landmark",
            title="H, the landmark's part",
            drive=DRIVES["04-h-landmark"],
            inputs=_pose_and_landmark,
            shapes={"result": (2, 2)},
            laws=(
                _difference(
                    "range-row",
                    1,
                    "the first row is how the range of h changes with the landmark's x, y",
                    by_landmark,
                    RANGE_ROW,
                ),
                _difference(
                    "bearing-row",
                    1,
                    "the second row is how the bearing of h changes with the landmark's x, y",
                    by_landmark,
                    BEARING_ROW,
                ),
            ),
            diagnoses=H_LANDMARK,
        ),
        Task(
            id="04-a-odometry",
            title="A of the odometry model",
            drive=DRIVES["04-a-odometry"],
            inputs=_pose_and_control,
            shapes={"result": (3, 3)},
            laws=(
                _difference(
                    "position-columns",
                    1,
                    "the first two columns are how the new pose changes with the old x, y",
                    by_pose,
                    np.s_[:, :2],
                ),
                _difference(
                    "heading-column",
                    2,
                    "the third column is how the new pose changes with the old θ",
                    by_pose,
                    np.s_[:, 2],
                ),
            ),
            diagnoses=A_ODOMETRY,
        ),
        Task(
            id="04-jxr-jz",
            title="J_xr and J_z of a new landmark",
            drive=DRIVES["04-jxr-jz"],
            inputs=_pose_and_measurement,
            shapes={"J_xr": (ROWS, 2, 3), "J_z": (ROWS, 2, 2)},
            laws=(
                _difference(
                    "J_xr",
                    2,
                    "J_xr is how the landmark g changes with the pose x, y, θ",
                    new_by_robot,
                    np.s_[:, :],
                    "J_xr",
                ),
                _difference(
                    "J_z",
                    2,
                    "J_z is how the landmark g changes with range and bearing",
                    new_by_measurement,
                    np.s_[:, :],
                    "J_z",
                ),
            ),
            diagnoses=J_XR + J_Z,
        ),
        Task(
            id="04-new-landmark",
            title="The covariance of a new landmark",
            drive=DRIVES["04-new-landmark"],
            inputs=_belief_and_measurement,
            shapes={"P_nn": (ROWS, 2, 2), "P_rn": (ROWS, 3, 2)},
            laws=(
                _covariance(
                    "P_nn",
                    2,
                    "P_nn is the covariance of the landmarks that sampled poses and "
                    "measurements give",
                    LANDMARK,
                    LANDMARK,
                ),
                _covariance(
                    "P_rn",
                    2,
                    "P_rn is the covariance between those sampled poses and their landmarks",
                    POSE,
                    LANDMARK,
                ),
            ),
            diagnoses=P_NN + P_RN,
            needs=("04-jxr-jz",),
        ),
    ),
)
