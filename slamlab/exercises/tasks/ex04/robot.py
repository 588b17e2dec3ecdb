"""04-h-robot: how range and bearing of a landmark change with the robot's pose."""

import numpy as np

from slamlab import models
from slamlab.exercises.drives.ex04 import DRIVES
from slamlab.exercises.law import equals
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex04.generic import DIFFERENCED, differences, polar, poses

ROWS = 24


def _seen_from(x, z):
    """Poses and the landmarks that they see at range and bearing."""
    return {"x": x, "p": models.g(x, z)}


def _random(rng):
    return _seen_from(poses(rng, ROWS), polar(rng, ROWS, 0.5, 8))


def _ahead(rng):
    return {"x": np.zeros((1, 3)), "p": np.array([[2.0, 0.0]])}


def _along_x(rng):
    x = poses(rng, 2)
    return {"x": x, "p": x[:, :2] + [[3.0, 0.0], [-2.0, 0.0]]}


def _behind(rng):
    """Seen at ±π, on which side of the cut there depends on the sign of a zero."""
    return {"x": np.zeros((2, 3)), "p": np.array([[-2.0, 0.0], [-3.0, -0.0]])}


def _aside(rng):
    x = poses(rng, 2)
    return {"x": x, "p": x[:, :2] + [[0.0, 2.0], [0.0, -3.0]]}


def _whole(rng):
    x = np.array([[1.0, 2, 0], [-2, 1, 3], [0, -1, -2]])
    return {"x": x, "p": np.array([[4.0, 6], [3, -11], [-3, 3]])}


def _near_and_far(rng):
    z = polar(rng, 6)
    z[:, 0] = [0.2, 0.3, 0.4, 15, 20, 30]
    return _seen_from(poses(rng, 6), z)


def _turned(rng):
    x = poses(rng, 4)
    x[:, 2] = [np.pi, -np.pi, 3 * np.pi / 2, 7.0]
    return _seen_from(x, polar(rng, 4))


def _by_robot(inputs):
    """∂h/∂x by differences, (n, 2, 3)."""
    p = inputs["p"][:, None]
    return {"result": differences(lambda x: models.h(x, p), inputs["x"], 1)}


def _way_there(inputs):
    dx, dy = (inputs["p"] - inputs["x"][:, :2]).T
    return {"dx": dx, "dy": dy, "r": np.hypot(dx, dy)}


def _parts(inputs, outputs):
    H = outputs["result"]
    return {"range": H[:, 0], "bearing by place": H[:, 1, :2], "bearing by heading": H[:, 1, 2]}


def _row(name, points, says, row, asks):
    return equals(
        name,
        points,
        says,
        _by_robot,
        parts={"result": np.s_[row]},
        tolerance=DIFFERENCED,
        asks=asks,
        step=_way_there,
    )


def _promised(inputs):
    """(n,) whether the landmark is not at the robot itself."""
    return np.hypot(*(inputs["p"] - inputs["x"][:, :2]).T) > 0.1


TASK = Task(
    id="04-h-robot",
    title="H, the robot's part",
    drive=DRIVES["04-h-robot"],
    inputs=_random,
    shapes={"result": (2, 3)},
    laws=(
        _row(
            "range-row",
            1,
            "the first row is how the range of h changes with x, y, θ",
            0,
            "The robot takes a small step straight towards the landmark, then one to its side, "
            "then turns on the spot: what does each do to the distance?",
        ),
        _row(
            "bearing-row",
            2,
            "the second row is how the bearing of h changes with x, y, θ",
            1,
            "The landmark is 2 m ahead and the robot steps 1 cm to its left: by which angle, and "
            "to which side, does the landmark move? What if it were 4 m ahead?",
        ),
    ),
    probes=(
        Probe("a landmark straight ahead of a robot at the origin", _ahead),
        Probe("landmarks exactly along +x and −x", _along_x),
        Probe("landmarks exactly along +y and −y", _aside),
        Probe("landmarks straight behind a robot at the origin", _behind),
        Probe("whole numbers", _whole),
        Probe("landmarks at 20 cm and at 30 m", _near_and_far),
        Probe("headings at π and beyond", _turned),
    ),
    parts=_parts,
    rounds=_promised,
)
