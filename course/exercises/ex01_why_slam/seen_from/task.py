"""Task 01-seen-from: one pose relative to another."""

import numpy as np

from classroom.exercises.references import Reference
from classroom.exercises.task import Probe, Task
from course.exercises.ex01_why_slam import motions
from course.exercises.ex01_why_slam.calls import CALLS
from slamlab.geometry import between, compose

COUNT = 24


def _pairs(rng, count=COUNT):
    # in half of them the difference of headings leaves (-π, π]
    a, b = motions.poses(rng, count), motions.poses(rng, count)
    half = count // 2
    first, second = motions.turned_beyond(rng, half, 1.8, 3.1)
    a[:half, 2], b[:half, 2] = first, -second
    return {"a": a, "b": b}


def _led(*step):
    def pairs(rng):
        a = motions.poses(rng, 3)
        return {"a": a, "b": compose(a, np.tile(np.array(step, dtype=float), (3, 1)))}

    return pairs


def _along_the_axes(rng):
    places = rng.integers(-5, 6, (2, 4, 2)).astype(float)
    turns = motions.QUARTERS, rng.permutation(motions.QUARTERS)
    a, b = (np.column_stack(pose) for pose in zip(places, turns, strict=True))
    return {"a": a, "b": b}


def _far(rng):
    inputs = _pairs(rng, 4)
    return {name: pose * [300, 300, 1] for name, pose in inputs.items()}


def _want(inputs):
    return {"result": between(inputs["a"], inputs["b"])}


def _on_the_way(inputs):
    return {
        "vector from a to b, in the world frame": inputs["b"][:, :2] - inputs["a"][:, :2],
        "heading of a": inputs["a"][:, 2],
    }


SEEN_FROM = Task(
    id="01-seen-from",
    title="The relative pose",
    call=CALLS["01-seen-from"],
    inputs=_pairs,
    shapes={"result": (3,)},
    laws=motions.laws_of_a_pose(
        _want,
        "the returned distances ahead and to the left lead from the position of a to the position "
        "of b",
        "after this turn, a robot with the heading of a has the heading of b (up to full turns)",
        (
            "You face along +y, and a person is at a distance of one metre from you along +x. How "
            "far is this person ahead of you, and how far to your left?",
            "Pose a has the heading 30°, and pose b has the heading 50°. By which angle must a "
            "turn?",
            "Pose a has the heading 170°, and pose b has the heading −170°. What is the smallest "
            "turn from a to b?",
        ),
        _on_the_way,
        lambda i: {"θ_b − θ_a, not wrapped": i["b"][:, 2] - i["a"][:, 2]},
    ),
    probes=(
        Probe("a and b at the same position", _led(0, 0, 1.2)),
        Probe("a and b the same", _led(0, 0, 0)),
        Probe("b straight behind a", _led(-2, 0, 0.4)),
        Probe("b to the left of a, back to back", _led(0, 1.5, np.pi)),
        Probe("poses along the axes", _along_the_axes),
        Probe("poses far apart", _far),
    ),
    parts=motions.parts_of_a_pose,
    needs=("01-next-pose",),
    references=(Reference("seen_from", "a b", _want),),
    begins=(
        "Which step leads from a to b if a faces along +x, and which if a faces along +y?",
        "Which vector leads from the position of a to the position of b?",
    ),
)
