"""Task 01-next-pose: where one step leads."""

import numpy as np

from slamlab.exercises.drives.ex01 import DRIVES
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex01 import motions
from slamlab.geometry import compose

COUNT = 24


def _steps(rng, count=COUNT):
    """Poses and steps; the turns of a third of them cross ±π."""
    inputs = {"pose": motions.poses(rng, count), "step": motions.steps(rng, count)}
    third = count // 3
    crossing = motions.turned_beyond(rng, third, 0.8, 1.5)
    inputs["pose"][:third, 2], inputs["step"][:third, 2] = crossing
    return inputs


def _only(rng, *places):
    """Steps of which only some numbers are not zero."""
    inputs = _steps(rng, 3)
    return inputs | {"step": inputs["step"] * np.isin(np.arange(3), places)}


def _along_the_axes(rng):
    """Whole metres and quarter turns."""
    pose = np.column_stack([rng.integers(-5, 6, (4, 2)).astype(float), motions.QUARTERS])
    turn = rng.permutation(motions.QUARTERS)
    return {"pose": pose, "step": np.column_stack([rng.integers(1, 4, (4, 2)), turn])}


def _large_turns(rng):
    inputs = _steps(rng, 4)
    inputs["pose"][:, 2], inputs["step"][:, 2] = motions.turned_beyond(rng, 4, 2.8, 3.1)
    return inputs


def _far(rng):
    inputs = _steps(rng, 4)
    inputs["pose"][:, :2] *= 300
    return inputs | {"step": inputs["step"] * [200, 200, 1]}


def _want(inputs):
    return {"result": compose(inputs["pose"], inputs["step"])}


def _on_the_way(inputs):
    theta = inputs["pose"][:, 2]
    ahead = np.column_stack([np.cos(theta), np.sin(theta)])
    return {
        "one metre forward is, in the world": ahead,
        "one metre to the left": ahead[:, ::-1] * [-1, 1],
    }


NEXT_POSE = Task(
    id="01-next-pose",
    title="Where one step leads",
    drive=DRIVES["01-next-pose"],
    inputs=_steps,
    shapes={"result": (3,)},
    laws=motions.laws_of_a_pose(
        _want,
        "the robot moves forward and to the left as the step says, along its old heading",
        "the heading grows by the turn (full turns do not matter)",
        (
            "A robot looks along +y and drives one metre forward. Which of x and y grows? And if "
            "it is pushed one metre to its left?",
            "A robot looks to 30° and turns by 20° to the left: where does it look then?",
            "A robot looks to 170° and turns by 20° to the left. Which angle between −180° and "
            "180° is that?",
        ),
        _on_the_way,
    ),
    probes=(
        Probe("no step at all", lambda rng: _only(rng)),
        Probe("a turn on the spot", lambda rng: _only(rng, 2)),
        Probe("a step straight ahead", lambda rng: _only(rng, 0)),
        Probe("a push to the side", lambda rng: _only(rng, 1)),
        Probe("robots that look along the axes", _along_the_axes),
        Probe("large turns", _large_turns),
        Probe("long steps far away", _far),
    ),
    parts=motions.parts_of_a_pose,
)
