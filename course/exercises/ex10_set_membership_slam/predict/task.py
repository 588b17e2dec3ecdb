"""Exercise 10, prediction: the tightest box of the positions after a motion."""

import numpy as np

from classroom.exercises.correctness_laws import Law
from classroom.exercises.task import Probe, Task
from course.exercises.ex10_set_membership_slam.boxes import around, boxes, wrapped
from course.exercises.ex10_set_membership_slam.calls import CALLS

ROWS = 24
QUARTER = np.pi / 2
TOLERANCE = 1e-8
"""Rounding alone, and what some add outwards [m]; in 200 km a million samples are 1e-7 off."""


def inputs(rng):
    """Intervals round every direction of the compass, some whole turns off."""
    k = np.arange(ROWS)
    # three rows for each of the four directions, the other rows anywhere
    of = np.where(k < 12, k % 4 * QUARTER, rng.uniform(-3, 3, ROWS))
    aside = rng.uniform(-2.5, 2.5, ROWS)
    # courses beyond a whole turn: right is at most π, so the direction makes up for the rest
    of[12:16] = np.array([4, 3, -4, -3]) * QUARTER
    aside[12:16] = np.array([1, 1, -1, -1]) * rng.uniform(3.9, 4.2, 4)
    back = np.where(k % 3 == 0, -1.0, 1.0)
    way = np.column_stack([rng.uniform(0.3, 2, ROWS) * back, rng.uniform(0.3, 2, ROWS)])
    given = drives(
        rng, of + rng.uniform(-0.2, 0.2, ROWS), rng.uniform(0.25, 0.6, ROWS), aside, np.sort(way)
    )
    return given | {"direction": around(aside, rng.uniform(0.05, 0.2, ROWS))}


def drives(rng, course, half, aside, way):
    """Motions whose heading and direction have their middles at a course (n,) [rad]."""
    n = len(course)
    return {
        "box": boxes(rng, n),
        "heading": wrapped(course - aside - half, 2 * np.asarray(half)),
        "way": np.broadcast_to(way, (n, 2)).copy(),
        "direction": np.tile(np.asarray(aside)[:, None], 2),
    }


def _exact(rng):
    given = inputs(rng)
    columns = {"box": [0, 0, 2, 2]}
    return {name: a[:, columns.get(name, [0, 0])] for name, a in given.items()}


def _round(rng):
    given = inputs(rng)
    wide = np.where(np.arange(ROWS) % 2, 2 * np.pi, rng.uniform(3.5, 5.5, ROWS))
    given["heading"][:, 1] = given["heading"][:, 0] + wide
    given["direction"][:, 1] = given["direction"][:, 0] + rng.uniform(2.9, 4, ROWS)
    return given


def _half_round(rng):
    given = inputs(rng)
    given["heading"][:, 1] = given["heading"][:, 0] + rng.uniform(2.5, 4.5, ROWS)
    return given


def _along_axes(rng):
    k = np.arange(16)
    low, wide = k % 4 * QUARTER - np.pi, np.where(k < 8, 1.0, QUARTER)
    course = np.where(k % 2, low - wide / 2, low + wide / 2)
    return drives(rng, course, wide / 2, np.zeros(16), np.sort(rng.uniform(-2, 2, (16, 2))))


def _far(rng):
    given = _along_axes(rng)
    given["direction"] += rng.uniform(-1e-4, 1e-4, (16, 1))
    return given | {"way": 1e5 * given["way"]}


def _backwards(rng):
    given = inputs(rng)
    return given | {"way": np.sort(-np.abs(given["way"]))}


def _still(rng):
    given = inputs(rng)
    way = np.zeros((ROWS, 2))
    way[::3, 1], way[1::3, 0] = rng.uniform(0.3, 1, 8), -rng.uniform(0.3, 1, 8)
    return given | {"way": way}


def _turns(rng):
    given = inputs(rng)
    turns = np.repeat([-3, -2, 2, 3], ROWS // 4)[:, None] * 2 * np.pi
    return given | {"direction": given["direction"] + turns}


def cosines(low, high):
    """(n, 2) the range of the cosine over intervals of angles (n,) each."""
    ends = np.sort(np.cos(np.column_stack([low, high])))
    for k, (angle, extreme) in enumerate(((np.pi, -1.0), (0.0, 1.0))):
        # a course may end at the extreme but for rounding: then its end is as good
        ends[np.mod(angle - low, 2 * np.pi) <= high - low, k] = extreme
    return ends


def hull(given):
    """The box of all ends: no quantity stands twice in x' or y', so intervals are exact."""
    course = given["heading"] + given["direction"]
    sides = []
    for of in (cosines(*course.T), cosines(*(course - QUARTER).T)):
        products = (given["way"][:, :, None] * of[:, None]).reshape(-1, 4)
        sides += [products.min(axis=1), products.max(axis=1)]
    return {"result": given["box"] + np.column_stack(sides)}


def _step(axis):
    def step(given):
        directions = given["heading"] + given["direction"]
        turned = directions - (QUARTER if axis == "sine" else 0)
        return {"directions θ + δ [rad]": directions, f"range of their {axis}": cosines(*turned.T)}

    return step


def _sides(name, axis, at):
    def holds(given, out):
        off = np.abs(out["result"] - hull(given)["result"])[:, at]
        return off.max(axis=1) <= TOLERANCE

    return Law(
        name,
        2,
        f"{name}_min and {name}_max are the smallest and the largest {name} that a motion can "
        "reach",
        holds,
        hull,
        asks=f"Which motion ends at the smallest {name}', and which at the largest? Is θ + δ of "
        f"this motion at an end of its interval, or inside, where the {axis} has an extreme?",
        step=_step(axis),
    )


PREDICT = Task(
    id="10-predict",
    title="Prediction of the box",
    call=CALLS["10-predict"],
    inputs=inputs,
    shapes={"result": (4,)},
    laws=(_sides("x", "cosine", np.s_[:2]), _sides("y", "sine", np.s_[2:])),
    probes=(
        Probe("intervals of zero width", _exact),
        Probe("an interval of θ + δ of more than a whole turn", _round),
        Probe("an interval of θ + δ of more than half a turn", _half_round),
        Probe("directions of several turns", _turns),
        Probe("an end of θ + δ along an axis", _along_axes),
        Probe("a long distance, and an end of θ + δ near an axis", _far),
        Probe("a robot that drives backwards", _backwards),
        Probe("a distance that may be 0", _still),
    ),
    parts=lambda given, out: dict(zip("xy", np.hsplit(np.arcsinh(out["result"]), 2), strict=True)),
    begins=(
        "In which directions can the robot drive? Add two intervals.",
        "Between which values does the cosine lie, if its angle lies in an interval? Where can its "
        "extremes be?",
        "Which products are possible, if both factors lie in intervals?",
    ),
)
