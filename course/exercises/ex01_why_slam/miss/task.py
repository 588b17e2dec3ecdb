"""Task 01-miss: the error at the end of any run, from errors of length and of heading."""

import numpy as np

from classroom.exercises.correctness_laws import equals
from classroom.exercises.task import Probe, Task
from course.exercises.ex01_why_slam import motions
from course.exercises.ex01_why_slam.calls import CALLS

COUNT, STEPS = 12, 9
NEAR = 3e-4
"""Relative tolerance: angles of 0.02 may be replaced by sines (7e-5), wrong formulas are less
accurate."""


def _drives(rng, count=COUNT, n=STEPS):
    tracks = [
        motions.chain(start, motions.steps(rng, n)[:n]) for start in motions.poses(rng, count)
    ]
    return {
        "poses": np.array(tracks),
        "length_error": rng.uniform(0.01, 0.03, count),
        "heading_error": rng.uniform(0.004, 0.02, count),
    }


def _without(name):
    return lambda rng: (inputs := _drives(rng, 5)) | {name: 0 * inputs[name]}


def _laps(rng):
    inputs = _drives(rng, 3, 6)
    inputs["poses"][:, -1] = inputs["poses"][:, 0]
    return inputs


def _straight(rng):
    steps = np.zeros((5, 7, 3))
    steps[..., 0] = 0.5 * np.array([1, 1, 1, 1, -1])[:, None]
    starts = motions.poses(rng, 5).round() * [1, 1, 0]
    starts[:, 2] = [*motions.QUARTERS, 0]
    tracks = [motions.chain(*drive) for drive in zip(starts, steps, strict=True)]
    return _drives(rng, 5) | {"poses": np.array(tracks)}


def _rests(rng):
    inputs = _drives(rng, 3)
    inputs["poses"][:, 3:6, :2] = inputs["poses"][:, 3:4, :2]
    return inputs


def _far(rng):
    inputs = _drives(rng, 3)
    inputs["poses"][..., :2] += 5000
    return inputs


def _long(rng):
    """Runs along the x-axis whose rounding exceeds a difference over a small step in y."""
    # a formula multiplies each lever by its error; a difference of two ends loses it
    poses = np.zeros((3, STEPS + 1, 3))
    poses[:, 1:, 0] = np.cumsum(rng.integers(2e11, 4e11, (3, STEPS)), axis=1)
    poses[..., 1] = rng.uniform(-3, 3, (3, STEPS + 1))
    return _drives(rng, 3) | {"poses": poses, "length_error": np.zeros(3)}


def _levers(inputs):
    """Derivative of the end by each heading error (k, n, 2)."""
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


def _by_length(inputs):
    moved = inputs["length_error"][:, None, None] * np.diff(inputs["poses"][..., :2], axis=1)
    return {"how far one σ of each length moves the end": moved}


def _law(name, points, says, asks, step=_on_the_way, **more):
    each = {"result": [0, 1]}
    return equals(name, points, says, _want, each, tolerance=NEAR, asks=asks, step=step, **more)


MISS = Task(
    id="01-miss",
    title="Drift on any run",
    call=CALLS["01-miss"],
    inputs=_drives,
    shapes={"result": (2,)},
    laws=(
        _law(
            "lengths",
            1,
            "the standard deviations in x and in y are right for length errors alone",
            "Suppose that a step along +x is 2 % too long. How far does this move the end in x, "
            "and in y?",
            step=_by_length,
            main=False,
        ),
        _law(
            "headings",
            2,
            "the standard deviations are right for heading errors alone",
            "Consider the straight line from pose k to the end. If it turns about pose k by a "
            "small angle, in which direction does its end move, and how far?",
            main=False,
        ),
        _law(
            "both",
            3,
            "the standard deviations are right for errors of both kinds",
            "All errors are independent. Which quantities of independent errors add?",
            after=("lengths", "headings"),
        ),
    ),
    probes=(
        Probe("length errors alone", _without("heading_error"), ("lengths",)),
        Probe("heading errors alone", _without("length_error"), ("headings",)),
        Probe("laps that end where they began", _laps, ("both",)),
        Probe("runs along the axes", _straight, ("both",)),
        Probe("runs with pauses", _rests, ("both",)),
        Probe("runs far from the origin", _far, ("both",)),
        Probe("runs of 10¹² m along the x-axis", _long, ("headings", "both")),
        Probe("a start and no step", lambda rng: _drives(rng, 2, 0), ("both",)),
        Probe("a single step", lambda rng: _drives(rng, 2, 1), ("both",)),
        Probe("forty steps", lambda rng: _drives(rng, 2, 40), ("both",)),
    ),
    parts=lambda i, o: {"result": np.arcsinh(o["result"])},  # the long runs would hide all others
    needs=("01-seen-from",),
    begins=(
        "A single step along +x is 2 % too long. How far does it move the end in x, and in y?",
        "A single heading error occurs at pose k. Which part of the trajectory does it turn?",
    ),
)
