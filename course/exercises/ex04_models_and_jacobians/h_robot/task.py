"""04-h-robot: derivatives of range and bearing with respect to the pose."""

import numpy as np

from classroom.exercises.correctness_laws import equals
from classroom.exercises.references import Reference
from classroom.exercises.task import Probe, Task
from course.exercises.ex04_models_and_jacobians.calls import CALLS
from course.exercises.ex04_models_and_jacobians.generic import polar, poses
from course.exercises.surveyed import EXACT, NAME, differences, surveyed
from slamlab import models

ROWS = 24


def _seen_from(x, z):
    return {"x": x, "p": models.g(x, z)}


def _random(rng):
    return _seen_from(poses(rng, ROWS), polar(rng, ROWS, 0.5, 8))


def _ahead(rng):
    return {"x": np.zeros((1, 3)), "p": np.array([[2.0, 0.0]])}


def _along_x(rng):
    x = poses(rng, 2)
    return {"x": x, "p": x[:, :2] + [[3.0, 0.0], [-2.0, 0.0]]}


def _behind(rng):
    # at ±π the side of the cut depends on the sign of a zero
    return {"x": np.zeros((2, 3)), "p": np.array([[-2.0, 0.0], [-3.0, -0.0]])}


def _aside(rng):
    x = poses(rng, 2)
    return {"x": x, "p": x[:, :2] + [[0.0, 2.0], [0.0, -3.0]]}


def _whole(rng):
    x = np.array([[1.0, 2, 0], [-2, 1, 3], [0, -1, -2]])
    return {"x": x, "p": np.array([[4.0, 6], [3, -11], [-3, 3]])}


def _near_and_far(rng):
    z = polar(rng, 6)
    z[:, 0] = [1e-4, 0.01, 0.4, 15, 20, 30]
    return _seen_from(poses(rng, 6), z)


def _far(rng):
    return surveyed(_seen_from(poses(rng, 6), polar(rng, 6, 1, 2)), "x", "p")


def _turned(rng):
    x = poses(rng, 4)
    x[:, 2] = [np.pi, -np.pi, 3 * np.pi / 2, 7.0]
    return _seen_from(x, polar(rng, 4))


def _offset(inputs):
    dx, dy = (inputs["p"] - inputs["x"][:, :2]).T
    return {"dx": dx, "dy": dy, "r": np.hypot(dx, dy)}


def _by_robot(inputs):
    """∂h/∂x, (n, 2, 3)."""
    dx, dy, r = _offset(inputs).values()
    none = np.zeros_like(r)
    rows = [[-dx / r, -dy / r, none], [dy / r**2, -dx / r**2, none - 1]]
    return {"result": np.moveaxis(np.array(rows), 2, 0)}


def _parts(inputs, outputs):
    H = outputs["result"]
    return {
        "range": H[:, 0],
        "bearing by place": H[:, 1, :2],
        "bearing by heading": H[:, 1, 2],
    }


def _row(name, points, says, row, asks):
    return equals(
        name,
        points,
        says,
        _by_robot,
        parts={"result": np.s_[row]},
        tolerance=EXACT,
        asks=asks,
        step=_offset,
    )


def _promised(inputs):
    return np.hypot(*(inputs["p"] - inputs["x"][:, :2]).T) > 0.99e-4


TASK = Task(
    id="04-h-robot",
    title="The Jacobian H of range and bearing",
    call=CALLS["04-h-robot"],
    inputs=_random,
    shapes={"result": (2, 3)},
    laws=(
        _row(
            "range-row",
            1,
            "the first row contains the derivatives of the range with respect to x, y, θ",
            0,
            "The robot moves a little straight towards the landmark, then sideways, then it turns "
            "on the spot. How does each motion change the range?",
        ),
        _row(
            "bearing-row",
            2,
            "the second row contains the derivatives of the bearing with respect to x, y, θ",
            1,
            "The landmark is 2 m ahead, and the robot moves 1 cm to its left. How does the "
            "bearing change? How does it change if the landmark is 4 m ahead, or if the robot "
            "turns left by 0.01 rad?",
        ),
    ),
    probes=(
        Probe("a landmark straight ahead of a robot at the origin", _ahead),
        Probe("landmarks exactly along +x and −x", _along_x),
        Probe("landmarks exactly along +y and −y", _aside),
        Probe("landmarks straight behind a robot at the origin", _behind),
        Probe("whole numbers", _whole),
        Probe("landmarks at 0.1 mm and at 30 m", _near_and_far),
        Probe("headings at π and beyond", _turned),
        Probe(NAME, _far),
    ),
    diagnoses=(differences(_by_robot),),
    parts=_parts,
    may_round=_promised,
    references=(Reference("H_robot", "x p", _by_robot),),
    begins=(
        "The landmark is 2 m ahead. By how much does the range change if the robot "
        "moves 1 cm ahead?",
        "By how much does the bearing change if the robot turns left by 0.01 rad?",
    ),
)
