"""Task 01-next-pose: the pose after one step."""

import numpy as np

from classroom.exercises.references import Reference
from classroom.exercises.task import Probe, Task
from course.exercises.ex01_why_slam import motions
from course.exercises.ex01_why_slam.calls import CALLS
from slamlab.geometry import compose

COUNT = 24


def _steps(rng, count=COUNT):
    # a third cross ±π
    inputs = {"pose": motions.poses(rng, count), "step": motions.steps(rng, count)}
    third = count // 3
    crossing = motions.turned_beyond(rng, third, 0.8, 1.5)
    inputs["pose"][:third, 2], inputs["step"][:third, 2] = crossing
    return inputs


def _only(rng, *places):
    inputs = _steps(rng, 3)
    return inputs | {"step": inputs["step"] * np.isin(np.arange(3), places)}


def _along_the_axes(rng):
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
        "one metre forward, in the world frame": ahead,
        "one metre to the left, in the world frame": ahead[:, ::-1] * [-1, 1],
    }


NEXT_POSE = Task(
    id="01-next-pose",
    title="Pose composition",
    call=CALLS["01-next-pose"],
    inputs=_steps,
    shapes={"result": (3,)},
    laws=motions.laws_of_a_pose(
        _want,
        "the position is right: forward and left are measured along the old heading",
        "the new heading is the old heading plus the turn (up to full turns)",
        (
            "A robot faces along +y and drives one metre forward. Does x or y change? Which of "
            "the two changes if the robot slips one metre to its left?",
            "A robot with heading 30° turns by 20° to the left. What is its new heading?",
            "A robot with heading 170° turns by 20° to the left. What is its heading, as an angle "
            "between −180° and 180°?",
        ),
        _on_the_way,
        lambda i: {"θ + turn, not wrapped": i["pose"][:, 2] + i["step"][:, 2]},
    ),
    probes=(
        Probe("no step at all", lambda rng: _only(rng)),
        Probe("a turn on the spot", lambda rng: _only(rng, 2)),
        Probe("a step straight ahead", lambda rng: _only(rng, 0)),
        Probe("a step to the side", lambda rng: _only(rng, 1)),
        Probe("headings along the axes", _along_the_axes),
        Probe("large turns", _large_turns),
        Probe("long steps far away", _far),
    ),
    parts=motions.parts_of_a_pose,
    begins=(
        "A robot faces along +y. Which coordinate changes if it drives one metre forward?",
        "Which direction of the world is ahead of a robot with heading θ? Which is to its left?",
    ),
    references=(Reference("next_pose", "pose step", _want),),
)
