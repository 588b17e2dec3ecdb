"""04-camera: the image column of a landmark, and its derivatives."""

import numpy as np

from classroom.exercises.correctness_laws import equals
from classroom.exercises.task import Probe, Task
from course.exercises.ex04_models_and_jacobians.calls import CALLS
from course.exercises.ex04_models_and_jacobians.generic import poses
from course.exercises.surveyed import EXACT, NAME, differences, surveyed

ROWS = 24
MANY = 1.4e6 * np.pi
"""A heading after many turns [rad]: the rounding of its last digits spoils finite differences."""


def _seen(x, mount, F, ahead, left):
    c, s = np.cos(x[:, 2]), np.sin(x[:, 2])
    forward, aside = mount[:, 0] + ahead, mount[:, 1] + left
    p = x[:, :2] + np.column_stack([c * forward - s * aside, s * forward + c * aside])
    return {"x": x, "p": p, "mount": mount, "F": F}


def _generic(rng, n):
    ahead = rng.uniform(1, 8, n)
    x, mount = poses(rng, n), rng.uniform(0.1, 0.5, (n, 2)) * rng.choice([-1, 1], (n, 2))
    return x, mount, rng.uniform(200, 800, n), ahead, ahead * rng.uniform(-0.8, 0.8, n)


def _random(rng):
    return _seen(*_generic(rng, ROWS))


def _simple(rng):
    x, mount = np.zeros((2, 3)), np.array([[0.0, 0.0], [0.5, 0.0]])
    return {"x": x, "p": np.array([[2.0, 1.0], [2.5, 1.0]]), "mount": mount, "F": np.full(2, 100.0)}


def _in_the_middle(rng):
    x, mount, F, ahead, left = _generic(rng, 3)
    return _seen(x, mount, F, ahead, 0 * left)


def _turned(rng):
    x, *rest = _generic(rng, 4)
    x[:, 2] = [np.pi, -np.pi, 3 * np.pi / 2, 7.0]
    return _seen(x, *rest)


def _at_the_side(rng):
    x, mount, F, ahead, _ = _generic(rng, 2)
    return _seen(x, mount, F, ahead, np.array([3.0, -4.0]) * ahead)


def _near_and_far(rng):
    x, mount, F, ahead, left = _generic(rng, 4)
    scale = np.array([0.001, 0.6, 15, 1000]) / ahead
    return _seen(x, mount, F, scale * ahead, scale * left)


def _often_turned(rng):
    x, *rest = _generic(rng, 6)
    x[:, 2] += MANY
    return _seen(x, *rest)


def _far(rng):
    x, mount, F, ahead, left = _generic(rng, 6)
    return surveyed(_seen(x, mount, F, 2 + ahead / 8, left / 4), "x", "p")


def _frame(inputs):
    """The landmark in the camera's frame: ahead, left."""
    (dx, dy), theta = (inputs["p"] - inputs["x"][:, :2]).T, inputs["x"][:, 2]
    c, s = np.cos(theta), np.sin(theta)
    a, b = inputs["mount"].T
    return {"X": c * dx + s * dy - a, "Y": c * dy - s * dx - b}


def _u(inputs):
    X, Y = _frame(inputs).values()
    return {"u": -inputs["F"] * Y / X}


def _H(inputs):
    """∂u/∂(x, y, θ, p_x, p_y), (n, 5)."""
    X, Y = _frame(inputs).values()
    theta, (a, b) = inputs["x"][:, 2], inputs["mount"].T
    c, s = np.cos(theta), np.sin(theta)
    X_by, Y_by = np.array([-c, -s, Y + b, c, s]), np.array([s, -c, -X - a, -s, c])
    return {"H": (inputs["F"] * (Y * X_by - X * Y_by) / X**2).T}


def _shapes(inputs):
    n = len(inputs["x"])
    return {"u": (n,), "H": (n, 5)}


def _parts(inputs, outputs):
    H = outputs["H"]
    return {"u": outputs["u"], "place": H[:, :2], "heading": H[:, 2], "landmark": H[:, 3:]}


def _entries(name, points, says, at, asks):
    return equals(
        name,
        points,
        says,
        _H,
        parts={"H": at},
        tolerance=EXACT,
        asks=asks,
        step=_frame,
    )


TASK = Task(
    id="04-camera",
    title="A camera beside the robot's centre",
    call=CALLS["04-camera"],
    inputs=_random,
    shapes=_shapes,
    laws=(
        equals(
            "column",
            1,
            "u is the column of the landmark in the image",
            _u,
            asks="Where is the landmark in the frame of the robot, and where is the camera in "
            "this frame? Which X and Y follow from these positions, and which quotient is u?",
            step=_frame,
        ),
        _entries(
            "place",
            1,
            "the first two entries of H are the derivatives of u with respect to the robot's x "
            "and y",
            np.s_[:2],
            "Suppose that the robot moves by 1 cm along the world's x axis. How do X and Y "
            "change? What is the derivative of a quotient if numerator and denominator change?",
        ),
        _entries(
            "heading",
            1.5,
            "the third entry of H is the derivative of u with respect to the heading",
            np.s_[2:3],
            "Suppose that the camera is at the centre. By how much does a turn of 0.01 rad change "
            "u in the middle of the image, and at Y = X? Which motion does the mount add?",
        ),
        _entries(
            "landmark",
            1,
            "the last two entries of H are the derivatives of u with respect to the landmark's x "
            "and y",
            np.s_[3:],
            "Suppose that robot and landmark both move 1 cm to the north. How does the image "
            "change?",
        ),
    ),
    probes=(
        Probe("a robot at the origin that looks along x", _simple),
        Probe("a landmark in the middle of the image", _in_the_middle),
        Probe("headings at π and beyond", _turned),
        Probe("landmarks at 1 mm and at 1 km", _near_and_far),
        Probe("landmarks far to the side", _at_the_side),
        Probe("headings after many turns", _often_turned, ("heading",)),
        Probe(NAME, _far, ("place", "landmark")),
    ),
    diagnoses=(differences(_H, exact=_u),),
    parts=_parts,
    may_round=False,  # a rounded landmark may lie behind the camera
    needs=("04-h-robot",),
    begins=(
        "The robot is at the origin with heading 0, and the camera is at its centre. "
        "Where does a landmark at (2, 1) appear?",
        "Where is the landmark in the frame of the robot?",
    ),
)
