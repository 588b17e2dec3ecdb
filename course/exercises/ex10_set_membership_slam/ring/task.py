"""Exercise 10, a range without a bearing: contraction of a box by a ring."""

import numpy as np

from classroom.exercises.correctness_laws import Law
from classroom.exercises.task import Probe, Task
from course.exercises.ex10_set_membership_slam.boxes import boxes_around
from course.exercises.ex10_set_membership_slam.calls import CALLS

CLOSE = 1e-7
"""What sides may be off [m]: roots of differences of numbers near 10 round to 1e-8 at worst."""
MARGIN = 0.02  # by which inputs are of their kind [m]
EACH = 6  # inputs of a kind
TRIED = 1500


def inputs(rng):
    """Boxes cut by the outer circle, the inner one, both, neither; some too far or near."""
    given = _drawn(rng, TRIED)
    kinds = [*_kinds(given).values()]
    return _rows(given, np.concatenate([np.flatnonzero(kind)[:EACH] for kind in kinds]))


def _drawn(rng, n, size=(0.05, 1.2), of_robot=(0.05, 0.4)):
    r, bound = rng.uniform(1.5, 3, n), rng.uniform(0.05, 0.3, n)
    angle, far = rng.uniform(-np.pi, np.pi, n), r + rng.uniform(-1.2, 1.2, n)
    at = rng.uniform(-3, 3, (n, 2))
    place = at + far[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
    return {
        "robot": boxes_around(at, rng.uniform(*of_robot, (n, 2))),
        "box": boxes_around(place, rng.uniform(*size, (n, 2))),
        "r": r,
        "bound": bound,
    }


def _rows(given, which):
    return {name: array[which] for name, array in given.items()}


def _kinds(given):
    outer = np.abs(cut(given, inner=False) - given["box"]).max(axis=1)
    ring = np.abs(cut(given) - cut(given, inner=False)).max(axis=1)
    least, most = (np.hypot(*side) for side in zip(*_apart(given), strict=True))
    near, far = given["r"] - given["bound"], given["r"] + given["bound"]
    some = (least < far - MARGIN) & (most > near + MARGIN)
    return {
        "outer": some & (outer > MARGIN) & (ring < 1e-12),
        "inner": some & (outer < 1e-12) & (ring > MARGIN),
        "both": some & (outer > MARGIN) & (ring > MARGIN),
        "neither": some & (outer < 1e-12) & (ring < 1e-12) & (least < near - MARGIN),
        "too far": least > far + MARGIN,
        "too near": most < near - MARGIN,
    }


def _of_kind(*names, **how):
    def inputs(rng):
        given = _drawn(rng, TRIED, **how)
        kinds = _kinds(given)
        return _rows(given, np.concatenate([np.flatnonzero(kinds[name])[:EACH] for name in names]))

    return inputs


def _round_the_robot(rng):
    n = 12
    given = _drawn(rng, n)
    middle = (given["robot"][:, ::2] + given["robot"][:, 1::2]) / 2
    half = np.where(np.arange(2 * n).reshape(n, 2) % 3, 0.2, 2) * given["r"][:, None]
    aside = rng.uniform(-0.4, 0.4, (n, 2)) * half
    return given | {"box": boxes_around(middle + aside, half)}


def _no_hole(rng):
    """Ranges below their bound; every second box is nearly a point."""
    given = _drawn(rng, 12, of_robot=(0.01, 0.03))
    given["bound"] = rng.uniform(0.3, 0.6, 12)
    given["r"] = np.where(np.arange(12) % 4 < 2, 0.0, given["bound"] * rng.uniform(0.1, 0.3, 12))
    size = np.where(np.arange(12) % 2, 0.02, 1.0)[:, None] * rng.uniform(0.8, 1.2, (12, 2))
    middle = (given["robot"][:, ::2] + given["robot"][:, 1::2]) / 2
    return given | {"box": boxes_around(middle + rng.uniform(-0.4, 0.4, (12, 2)) * size, size)}


def _exact_range(rng):
    given = _of_kind("outer", "both", "inner")(rng)
    return given | {"r": given["r"] + given["bound"], "bound": np.zeros(len(given["r"]))}


def _apart(given):
    """Least and most |difference| of object and robot, [x, y] with (n,) each."""
    least, most = [], []
    for k in (0, 2):
        low = given["box"][:, k] - given["robot"][:, k + 1]
        high = given["box"][:, k + 1] - given["robot"][:, k]
        least.append(np.maximum(0, np.maximum(low, -high)))
        most.append(np.maximum(np.abs(low), np.abs(high)))
    return least, most


def cut(given, inner=True):
    """(n, 4) the box round what is left; NaN where nothing is.
    The least |dy| gives the outer circle's largest |dx|, the most |dy| the inner one's least.
    """
    least, most = _apart(given)
    near = np.maximum(given["r"] - given["bound"], 0) * inner
    far = given["r"] + given["bound"]
    sides = []
    for k, across in ((0, 1), (2, 0)):
        to = np.sqrt(np.where(far >= least[across], far**2 - least[across] ** 2, np.nan))
        off = np.sqrt(np.maximum(near**2 - most[across] ** 2, 0))
        low, high = given["robot"][:, k], given["robot"][:, k + 1]
        pieces = np.stack([[low - to, high - off], [low + off, high + to]])
        lows = np.maximum(pieces[:, 0], given["box"][:, k])
        highs = np.minimum(pieces[:, 1], given["box"][:, k + 1])
        some = lows <= highs
        sides += [
            np.where(some, lows, np.inf).min(axis=0),
            np.where(some, highs, -np.inf).max(axis=0),
        ]
    found = np.column_stack(sides)
    return np.where(np.isfinite(found).all(axis=1, keepdims=True), found, np.nan)


def want(given):
    """The boxes as the function call returns them."""
    box = cut(given)
    left = np.isfinite(box).all(axis=1)
    return {"left": left.astype(float), "box": np.where(left[:, None], box, 0.0)}


def _same(given, out):
    right = want(given)
    same = np.abs(out["box"] - right["box"]).max(axis=1) <= CLOSE
    return same & (out["left"] == right["left"])


def _matters(given):
    """Whether something is left, and whether the inner circle changes it."""
    both, outer = cut(given), cut(given, inner=False)
    some = np.isfinite(both).all(axis=1)
    return some, some & (np.abs(both - outer).max(axis=1) > 0)


def _far(given, out):
    some, inner = _matters(given)
    return _same(given, out) | ~some | inner


def _near(given, out):
    return _same(given, out) | ~_matters(given)[1]


def _empty(given, out):
    return (out["left"] > 0) == _matters(given)[0]


def _on_the_way(given):
    least, most = _apart(given)
    return {"least |Δx|, |Δy|": np.column_stack(least), "most |Δx|, |Δy|": np.column_stack(most)}


def _law(name, points, says, holds, asks):
    return Law(name, points, says, holds, want=want, asks=asks, step=_on_the_way)


def _promised(given):
    """No circle just touches a box."""
    least, most = (np.hypot(*side) for side in zip(*_apart(given), strict=True))
    near, far = given["r"] - given["bound"], given["r"] + given["bound"]
    return (np.abs(least - far) > 0.001) & (np.abs(most - near) > 0.001)


RING = Task(
    id="10-ring",
    title="A range without a bearing",
    call=CALLS["10-ring"],
    inputs=inputs,
    shapes=lambda given: {"left": (len(given["r"]),), "box": (len(given["r"]), 4)},
    laws=(
        _law(
            "far",
            1.5,
            "if only the outer circle excludes points, the box is the smallest possible",
            _far,
            "How large can |Δx| be, if Δx² + Δy² is at most (r + bound)², and for which Δy?",
        ),
        _law(
            "near",
            2,
            "if the inner circle excludes points, the box is the smallest possible",
            _near,
            "How small can |Δx| be, and for which Δy? On which sides of the robot is it possible?",
        ),
        _law(
            "empty",
            0.5,
            "ring returns None if no point of the box agrees with the range, and only then",
            _empty,
            "What are the smallest and the largest possible distance of robot and landmark?",
        ),
    ),
    probes=(
        Probe("boxes beside and around the robot", _round_the_robot),
        Probe("a range smaller than its bound", _no_hole),
        Probe("an exact range", _exact_range),
        Probe(
            "a robot whose position is known exactly",
            _of_kind("outer", "inner", "both", "too far", of_robot=(0, 0)),
        ),
        Probe(
            "a landmark whose position is known exactly",
            _of_kind("neither", "too far", "too near", size=(0, 0)),
            ("far", "empty"),
        ),
    ),
    parts=lambda given, out: {
        "left": out["left"],
        "far": out["box"][np.logical_and(*_split(given))],
        "near": out["box"][_matters(given)[1]],
    },
    may_round=_promised,
    begins=(
        "Which interval does Δx have, if each box gives an interval for x? And |Δx|?",
        "How large can |Δx| be, if Δx² + Δy² is at most (r + bound)², and for which Δy?",
        "|Δx| has a smallest value, too. On how many sides of the robot can the landmark be?",
    ),
)


def _split(given):
    some, inner = _matters(given)
    return some, ~inner
