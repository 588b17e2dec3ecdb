"""Task 01-miss: how far any drive misses its end, by errors of length and of heading."""

import numpy as np

from slamlab.exercises.drives.ex01 import DRIVES
from slamlab.exercises.law import equals
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex01 import motions

COUNT, STEPS = 12, 9
NEAR = 2e-4
"""Share that an answer may be off: sines stand for angles of 0.02 (7e-5), no wrong form does."""


def _drives(rng, count=COUNT, n=STEPS):
    """Drives as they were meant, and how much each step errs in length and in heading."""
    tracks = [
        motions.chain(start, motions.steps(rng, n)[:n]) for start in motions.poses(rng, count)
    ]
    return {
        "poses": np.array(tracks),
        "length_error": rng.uniform(0.01, 0.03, count),
        "heading_error": rng.uniform(0.004, 0.02, count),
    }


def _without(name):
    """Drives that err in one way only."""
    return lambda rng: (inputs := _drives(rng, 5)) | {name: 0 * inputs[name]}


def _laps(rng):
    """Drives that end where they began."""
    inputs = _drives(rng, 3, 6)
    inputs["poses"][:, -1] = inputs["poses"][:, 0]
    return inputs


def _straight(rng):
    """Drives along the axes, to all four sides; the last robot drives backwards."""
    steps = np.zeros((5, 7, 3))
    steps[..., 0] = 0.5 * np.array([1, 1, 1, 1, -1])[:, None]
    starts = motions.poses(rng, 5).round() * [1, 1, 0]
    starts[:, 2] = [*motions.QUARTERS, 0]
    tracks = [motions.chain(*drive) for drive in zip(starts, steps, strict=True)]
    return _drives(rng, 5) | {"poses": np.array(tracks)}


def _rests(rng):
    """Drives that turn on the spot or stand still for some steps."""
    inputs = _drives(rng, 3)
    inputs["poses"][:, 3:6, :2] = inputs["poses"][:, 3:4, :2]
    return inputs


def _far(rng):
    inputs = _drives(rng, 3)
    inputs["poses"][..., :2] += 5000
    return inputs


def _levers(inputs):
    """(k, n, 2): how the end moves for each error of heading, a radian of it [m]."""
    p = inputs["poses"][..., :2]
    chord = p[:, -1:] - p[:, 1:]
    return np.stack([-chord[..., 1], chord[..., 0]], axis=-1)


def _want(inputs):
    lengths = inputs["length_error"][:, None, None] * np.diff(inputs["poses"][..., :2], axis=1)
    turns = inputs["heading_error"][:, None, None] * _levers(inputs)
    errors = np.concatenate([lengths, turns], axis=1)
    return {"result": np.sqrt(np.square(errors).sum(axis=1))}


def _on_the_way(inputs):
    return {"from each pose to the end": inputs["poses"][:, -1:, :2] - inputs["poses"][:, 1:, :2]}


def _law(name, points, says, asks, **more):
    return equals(name, points, says, _want, tolerance=NEAR, asks=asks, step=_on_the_way, **more)


MISS = Task(
    id="01-miss",
    title="How far any drive misses its end",
    drive=DRIVES["01-miss"],
    inputs=_drives,
    shapes={"result": (2,)},
    laws=(
        _law(
            "lengths",
            1,
            "the errors of the end in x and in y are right where wheels err in length only",
            "A step along +x is two per cent too long: what is that to the end's x, and to its y?",
            main=False,
        ),
        _law(
            "headings",
            2,
            "they are right where wheels err in heading only",
            "Hold a stick at one end and turn it by a small angle. Which way does its other end "
            "go, and how far? Which stick is it that an error at pose k turns?",
            main=False,
        ),
        _law(
            "both",
            3,
            "they are right where wheels err in both ways",
            "All errors are independent. Which of their numbers can be added up?",
            after=("lengths", "headings"),
        ),
    ),
    probes=(
        Probe("wheels that err in length only", _without("heading_error"), ("lengths",)),
        Probe("wheels that err in heading only", _without("length_error"), ("headings",)),
        Probe("laps that end where they began", _laps, ("both",)),
        Probe("drives along the axes", _straight, ("both",)),
        Probe("drives that rest", _rests, ("both",)),
        Probe("drives far from the origin", _far, ("both",)),
        Probe("a start and no step", lambda rng: _drives(rng, 2, 0), ("both",)),
        Probe("a single step", lambda rng: _drives(rng, 2, 1), ("both",)),
        Probe("forty steps", lambda rng: _drives(rng, 2, 40), ("both",)),
    ),
)
