"""Task 15-jacobians: how an edge's error feels its two poses."""

from functools import partial

import numpy as np

from slamlab.exercises.drives.ex15 import DRIVES
from slamlab.exercises.law import Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex04_laws import STEP, close
from slamlab.exercises.tasks.ex04_mistakes import DEGREE, matrix, mistake, sign_mistake
from slamlab.exercises.tasks.ex15_error import edges
from slamlab.geometry import wrap
from slamlab.posegraph.edge_error import error


def slopes(inputs):
    """∂e/∂x_i and ∂e/∂x_j by differences of the error, each (n, 3, 3)."""
    return [_differences(inputs, name) for name in ("x_i", "x_j")]


def _differences(inputs, name):
    columns = []
    for h in STEP * np.eye(3):
        up, down = (error(**(inputs | {name: inputs[name] + to * h})) for to in (1, -1))
        columns.append((up - down) / (2 * STEP))
        columns[-1][:, 2] = wrap(up[:, 2] - down[:, 2]) / (2 * STEP)
    return np.stack(columns, axis=-1)


def _A(inputs, outputs):
    return close(outputs["A"], slopes(inputs)[0])


def _B(inputs, outputs):
    return close(outputs["B"], slopes(inputs)[1])


# ---- mistakes -------------------------------------------------------------------------------


def _back(angle):
    """Rᵀ of angles, as a function of the inputs."""

    def made(inputs):
        a = angle(inputs)
        c, s = np.cos(a), np.sin(a)
        return matrix([[c, s], [-s, c]])

    return made


def _sum(i):
    return i["x_i"][:, 2] + i["z"][:, 2]


def _theta(i):
    return i["x_i"][:, 2]


def _theta_z(i):
    return i["z"][:, 2]


def _swing(angle):
    """A's heading column with another angle: what turning pose i does to the way it sees."""

    def made(inputs):
        dx, dy = (inputs["x_j"] - inputs["x_i"])[:, :2].T
        a = angle(inputs)
        c, s = np.cos(a), np.sin(a)
        return np.column_stack([-s * dx + c * dy, -c * dx - s * dy])

    return made


def _whole(k):
    return lambda inputs: slopes(inputs)[k]


def _swing_of_error(i):
    """As if the frame that turned were that of e: z's shift is carried along."""
    e = error(i["x_i"], i["x_j"], i["z"])
    return np.column_stack([e[:, 1], -e[:, 0]])


ROTATION, COLUMN = np.s_[:2, :2], np.s_[:2, 2]
ANGLE = (
    "{} is turned by another angle. e is written in the frame that z leads to from pose i: "
    "its heading is θ_i + θ_z."
)
FORTH = "{}'s block turns the wrong way: what is seen *from* a frame is turned back, by Rᵀ."
_in_A, _in_B = partial(mistake, output="A"), partial(mistake, output="B")

MISTAKES = (
    _in_A("swapped", "A and B have changed places: A is by x_i, B by x_j.", _whole(1)),
    _in_B(
        "b-transposed",
        "This is the transpose of B: a row per component of e, a column per component of x_j. "
        "(Or R for Rᵀ: what is seen from a frame is turned back.)",
        lambda i: _whole(1)(i).transpose(0, 2, 1),
    ),
    _in_A(
        "a-transposed",
        "This is the transpose of A: a row per component of e, a column per component of x_i.",
        lambda i: _whole(0)(i).transpose(0, 2, 1),
    ),
    _in_B(
        "b-angle",
        ANGLE.format("B"),
        _back(_theta),
        _back(_theta_z),
        _back(lambda i: i["x_i"][:, 2] - i["z"][:, 2]),
        _back(lambda i: i["x_j"][:, 2]),
        lambda i: np.eye(2),
        part=ROTATION,
    ),
    _in_A(
        "a-sign",
        "A has B's sign. Move pose i towards pose j: does j come nearer, or go farther?",
        _back(_sum),
        part=ROTATION,
    ),
    _in_A(
        "a-angle",
        ANGLE.format("A"),
        lambda i: -_back(_theta)(i),
        lambda i: -_back(_theta_z)(i),
        lambda i: -_back(lambda k: k["x_i"][:, 2] - k["z"][:, 2])(i),
        lambda i: -np.eye(2),
        part=ROTATION,
    ),
    _in_A(
        "a-turned-forth",
        FORTH.format("A"),
        lambda i: -_back(_sum)(i).transpose(0, 2, 1),
        part=ROTATION,
    ),
    _in_A(
        "a-heading-missing",
        "A's heading column is empty, as if A were −B: turn the robot at pose i, and all that it "
        "sees swings round it.",
        lambda i: np.zeros(2),
        part=COLUMN,
    ),
    _in_A(
        "a-heading-angle",
        "A's heading column is turned by another angle: it is the derivative of R(θ_i)ᵀ times the "
        "way from i to j, and then turned by −θ_z as well.",
        _swing(_theta),
        _swing(_theta_z),
        part=COLUMN,
    ),
    _in_A(
        "a-heading-of-e",
        "A's heading column was taken of e itself, but z's shift does not swing: only the way from "
        "pose i to pose j does.",
        _swing_of_error,
        part=COLUMN,
    ),
    _in_A(
        "a-heading-swapped",
        "The two entries of A's heading column have changed places, or sine and cosine have.",
        lambda i: _swing(_sum)(i)[:, ::-1],
        part=COLUMN,
        sizes_only=True,
    ),
    sign_mistake(
        "a-heading-sign",
        "A sign in A's heading column: turn pose i to the left, and what it sees moves to the "
        "right.",
        _swing(_sum),
        part=COLUMN,
        output="A",
    ),
    _in_A(
        "a-turn",
        "The last entry of A: by what does θ_j − θ_i − θ_z change when θ_i grows by one?",
        lambda i: np.ones(1),
        lambda i: np.zeros(1),
        part=np.s_[2, 2],
    ),
    _in_B(
        "b-turn",
        "The last entry of B: by what does θ_j − θ_i − θ_z change when θ_j grows by one?",
        lambda i: -np.ones(1),
        lambda i: np.zeros(1),
        part=np.s_[2, 2],
    ),
    _in_A(
        "degrees",
        "Degrees and radians are mixed: angles come in radians, np.sin and np.cos take radians.",
        lambda i: -_back(lambda k: _sum(k) * DEGREE)(i),
        lambda i: -_back(lambda k: _sum(k) / DEGREE)(i),
        part=ROTATION,
    ),
)

JACOBIANS = Task(
    id="15-jacobians",
    title="How the error feels its poses",
    drive=DRIVES["15-jacobians"],
    inputs=edges,
    shapes={"A": (None, 3, 3), "B": (None, 3, 3)},
    laws=(
        Law("A", 3, "A holds the differences of e when x_i is moved a little", _A),
        Law("B", 2, "B holds the differences of e when x_j is moved a little", _B),
    ),
    diagnoses=MISTAKES,
)
