"""04-jxr-jz: derivatives of a new landmark with respect to pose and measurement."""

import numpy as np

from classroom.exercises.correctness_laws import equals
from classroom.exercises.task import Probe, Task
from course.exercises.ex04_models_and_jacobians.calls import CALLS
from course.exercises.ex04_models_and_jacobians.generic import polar, poses
from course.exercises.surveyed import EXACT, NAME, differences, rounded, surveyed

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


def _far(rng):
    return surveyed({"x": poses(rng, 6), "z": polar(rng, 6, 0.5, 1.5)}, "x")


def by_measurement(inputs):
    """∂g/∂z, (n, 2, 2)."""
    r, (c, s) = inputs["z"][:, 0], (f(_direction(inputs)) for f in (np.cos, np.sin))
    return np.moveaxis(np.array([[c, -r * s], [s, r * c]]), 2, 0)


def by_pose(inputs):
    """∂g/∂x, (n, 2, 3)."""
    moves = np.broadcast_to(np.eye(2), (len(inputs["x"]), 2, 2))
    return np.concatenate([moves, by_measurement(inputs)[:, :, 1:]], axis=2)


def _both(inputs):
    return {"J_xr": by_pose(inputs), "J_z": by_measurement(inputs)}


def _shapes(inputs):
    n = len(inputs["x"])
    return {"J_xr": (n, 2, 3), "J_z": (n, 2, 2)}


def _direction(inputs):
    return inputs["x"][:, 2] + inputs["z"][:, 1]


def _on_the_way(inputs):
    return {"direction of the landmark in the world": _direction(inputs)}


def _parts(inputs, outputs):
    J_xr = outputs["J_xr"]
    return {
        "J_xr by place": J_xr[:, :, :2],
        "J_xr by heading": J_xr[:, :, 2],
        "J_z": outputs["J_z"],
    }


def _promised(inputs):
    return inputs["z"][:, 0] > 0


def _exact(name, says, derivative, asks):
    def want(inputs):
        return {name: derivative(inputs)}

    law = equals(name, 2, says, want, tolerance=EXACT, asks=asks, step=_on_the_way)
    return rounded(law, want)


TASK = Task(
    id="04-jxr-jz",
    title="J_xr and J_z of a new landmark",
    call=CALLS["04-jxr-jz"],
    inputs=_random,
    shapes=_shapes,
    laws=(
        _exact(
            "J_xr",
            "J_xr contains the derivatives of the landmark g with respect to x, y, θ of the pose",
            by_pose,
            "Imagine that the landmark is the end of a stick that is fixed to the robot. "
            "Move the robot a little, then turn it. How far does the end of the stick move, and "
            "in which direction?",
        ),
        _exact(
            "J_z",
            "J_z contains the derivatives of the landmark g with respect to range and bearing",
            by_measurement,
            "Increase the range by 1 cm, then the bearing by 0.01 rad. In which direction "
            "does the landmark move each time? Does the distance that it moves depend on the "
            "range?",
        ),
    ),
    probes=(
        Probe("a landmark straight ahead of a robot at the origin", _ahead),
        Probe("whole numbers", _whole),
        Probe("ranges of 10 cm and of 30 m", _near_and_far),
        Probe("angles with a sum beyond π", _beyond),
        Probe(NAME, _far),
    ),
    diagnoses=(differences(_both),),
    parts=_parts,
    may_round=_promised,
    needs=("04-h-robot",),
    begins=(
        "The landmark lies in the direction of the x axis. Which coordinate changes "
        "if the range grows by 1 cm?",
        "In which direction does the landmark move if the bearing grows a little?",
    ),
)
