"""04-jxr-jz: how a new landmark moves with the pose and the measurement it was placed from."""

import numpy as np

from slamlab import models
from slamlab.exercises.drives.ex04 import DRIVES
from slamlab.exercises.law import equals
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex04.generic import DIFFERENCED, differences, polar, poses

ROWS = 24


def _random(rng):
    return {"x": poses(rng, ROWS), "z": polar(rng, ROWS)}


def _ahead(rng):
    return {"x": np.zeros((1, 3)), "z": np.array([[2.0, 0.0]])}


def _whole(rng):
    x = np.array([[1.0, 2, 0], [0, 0, 2], [-3, 1, -1]])
    return {"x": x, "z": np.array([[3.0, 1], [2, 0], [5, -2]])}


def _near_and_far(rng):
    z = polar(rng, 6)
    z[:, 0] = [0.1, 0.2, 0.3, 15, 20, 30]
    return {"x": poses(rng, 6), "z": z}


def _beyond(rng):
    x, z = poses(rng, 4), polar(rng, 4)
    x[:, 2], z[:, 1] = [3.0, -3.0, np.pi, -np.pi], [2.5, -2.5, np.pi, 1.0]
    return {"x": x, "z": z}


def by_pose(inputs):
    """∂g/∂x by differences, (n, 2, 3)."""
    z = inputs["z"][:, None]
    return differences(lambda x: models.g(x, z), inputs["x"])


def by_measurement(inputs):
    """∂g/∂z by differences, (n, 2, 2)."""
    x = inputs["x"][:, None]
    return differences(lambda z: models.g(x, z), inputs["z"])


def _shapes(inputs):
    n = len(inputs["x"])
    return {"J_xr": (n, 2, 3), "J_z": (n, 2, 2)}


def _line_of_sight(inputs):
    return {"direction of the beam in the world": inputs["x"][:, 2] + inputs["z"][:, 1]}


def _parts(inputs, outputs):
    J_xr = outputs["J_xr"]
    return {
        "J_xr by place": J_xr[:, :, :2],
        "J_xr by heading": J_xr[:, :, 2],
        "J_z": outputs["J_z"],
    }


def _promised(inputs):
    """(n,) whether ranges are positive."""
    return inputs["z"][:, 0] > 0


TASK = Task(
    id="04-jxr-jz",
    title="J_xr and J_z of a new landmark",
    drive=DRIVES["04-jxr-jz"],
    inputs=_random,
    shapes=_shapes,
    laws=(
        equals(
            "J_xr",
            2,
            "J_xr is how the landmark g changes with the pose x, y, θ",
            lambda inputs: {"J_xr": by_pose(inputs)},
            tolerance=DIFFERENCED,
            asks="The landmark sits at the end of a stick that is fixed to the robot. Shift the "
            "robot, then turn it by a little: how far does the end move, and in which direction?",
            step=_line_of_sight,
        ),
        equals(
            "J_z",
            2,
            "J_z is how the landmark g changes with range and bearing",
            lambda inputs: {"J_z": by_measurement(inputs)},
            tolerance=DIFFERENCED,
            asks="Lengthen the beam by 1 cm, then turn it by 0.01 rad: in which direction does its "
            "end move each time, and does it matter how long the beam is?",
            step=_line_of_sight,
        ),
    ),
    probes=(
        Probe("a landmark straight ahead of a robot at the origin", _ahead),
        Probe("whole numbers", _whole),
        Probe("ranges of 10 cm and of 30 m", _near_and_far),
        Probe("angles whose sum goes beyond π", _beyond),
    ),
    parts=_parts,
    rounds=_promised,
)
