"""Task 01-seen-from: one pose seen from another."""

import numpy as np

from slamlab.exercises.drives.ex01 import DRIVES
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex01 import motions
from slamlab.geometry import between, compose

COUNT = 24


def _pairs(rng, count=COUNT):
    """Pairs of poses; in a half of them the plain difference of headings leaves (-π, π]."""
    a, b = motions.poses(rng, count), motions.poses(rng, count)
    half = count // 2
    first, second = motions.turned_beyond(rng, half, 1.8, 3.1)
    a[:half, 2], b[:half, 2] = first, -second
    return {"a": a, "b": b}


def _led(*step):
    """Pairs of poses of which one step leads to the other."""

    def pairs(rng):
        a = motions.poses(rng, 3)
        return {"a": a, "b": compose(a, np.tile(np.array(step, dtype=float), (3, 1)))}

    return pairs


def _along_the_axes(rng):
    """Whole metres apart, headed along the axes."""
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
        "from a to b, in the world": inputs["b"][:, :2] - inputs["a"][:, :2],
        "a looks to": inputs["a"][:, 2],
    }


SEEN_FROM = Task(
    id="01-seen-from",
    title="One pose seen from another",
    drive=DRIVES["01-seen-from"],
    inputs=_pairs,
    shapes={"result": (3,)},
    laws=motions.laws_of_a_pose(
        _want,
        "going that far ahead and that far to the left leads from a to b",
        "a robot at a that makes this turn looks where b looks (full turns do not matter)",
        (
            "You look along +y, and somebody stands one metre to the east of you. How far ahead of "
            "you is that, and how far to your left?",
            "You look to 30° and the other one to 50°: by how much do you have to turn?",
            "You look to 170° and the other one to −170°. Which is the short way to turn?",
        ),
        _on_the_way,
    ),
    probes=(
        Probe("a and b in one place", _led(0, 0, 1.2)),
        Probe("a and b the same", _led(0, 0, 0)),
        Probe("b straight behind a", _led(-2, 0, 0.4)),
        Probe("b to the left of a, back to back", _led(0, 1.5, np.pi)),
        Probe("poses along the axes", _along_the_axes),
        Probe("poses far apart", _far),
    ),
    parts=motions.parts_of_a_pose,
)
