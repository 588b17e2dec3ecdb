"""Task 10-relaxed: positions in all boxes but a few, and the measurements that are outliers."""

import numpy as np

from classroom.exercises.correctness_laws import Law, once
from classroom.exercises.task import Probe, Task
from course.exercises.ex10_set_membership_slam.boxes import boxes_around
from course.exercises.ex10_set_membership_slam.calls import CALLS

CLOSE = 1e-7  # allowed error of a side [m]
EACH = 4  # inputs of a kind
DRAWN = 2000


def inputs(rng):
    """Boxes whose relaxed intersection is empty, has several pieces, or is no box."""
    given = drawn(rng, DRAWN)
    kinds = _kinds(given)
    return _rows(given, np.concatenate([np.flatnonzero(kind)[:EACH] for kind in kinds.values()]))


def drawn(rng, rows, n=9, q=(1, 6), size=(0.2, 0.8)):
    """Boxes (rows, n, 4) about two places or between them; how many can be outliers (rows,)."""
    places = rng.uniform(-1.5, 1.5, (rows, 3, 2))
    places[:, 2] = places[:, :2].mean(axis=1)
    half = rng.uniform(*size, (rows, n, 2))
    which = rng.choice([0, 1, 2], (rows, n), p=[0.5, 0.35, 0.15])
    which[4::5] = 0  # all boxes meet
    middle = np.take_along_axis(places, which[..., None], axis=1)
    middle = middle + half * rng.uniform(-0.9, 0.9, half.shape)
    boxes = boxes_around(middle.reshape(-1, 2), half.reshape(-1, 2))
    return {"boxes": boxes.reshape(rows, n, 4), "q": rng.integers(*q, rows).astype(float)}


def _rows(given, which):
    return {name: array[which] for name, array in given.items()}


def _within(boxes, ends):
    """Whether box k contains the point (x of box i, y of box j): (i, j, k), by the given ends."""
    x, y = (boxes[:, end][:, None] for end in ends)
    x, y = ((boxes[:, low] <= at) & (at <= boxes[:, low + 1]) for low, at in ((0, x), (2, y)))
    return x[:, None] & y[None]


def _relaxed(boxes, q):
    """Smallest box around the relaxed intersection or None, and flags of the certain outliers."""
    least = len(boxes) - q
    low, high = _within(boxes, (0, 2)), _within(boxes, (1, 3))
    i, j = np.nonzero(low.sum(axis=2) >= least)
    if not len(i):
        return None, np.zeros(len(boxes))
    a, b = np.nonzero(high.sum(axis=2) >= least)
    sides = boxes[i, 0].min(), boxes[a, 1].max(), boxes[j, 2].min(), boxes[b, 3].max()
    return np.array(sides), 1.0 - low[i, j].any(axis=0)


@once
def want(given):
    """The outputs as the function call returns them."""
    found = [_relaxed(boxes, q) for boxes, q in zip(*given.values(), strict=True)]
    return {
        "left": np.array([float(box is not None) for box, _ in found]),
        "box": np.array([np.zeros(4) if box is None else box for box, _ in found]),
        "outliers": np.array([outliers for _, outliers in found]),
    }


def _kinds(given):
    right, boxes = want(given), given["boxes"]
    some, hull = right["left"] > 0, right["box"][:, None]
    apart = [
        (boxes[..., k] > hull[..., k + 1]) | (hull[..., k] > boxes[..., k + 1]) for k in (0, 2)
    ]
    meets = (right["outliers"] > 0) & ~np.logical_or(*apart)
    least = (boxes.shape[1] - given["q"])[:, None]
    sides = {k: _within_each(boxes, k).sum(axis=2) >= least for k in (0, 2)}
    wider = [(side & (boxes[..., k] < hull[..., k])).any(axis=1) for k, side in sides.items()]
    most = np.array([_within(row, (0, 2)).sum(axis=2).max() for row in boxes])
    return {
        "no outlier": some & ~right["outliers"].any(axis=1),
        "an outlier in the gap of two pieces": some & meets.any(axis=1),
        "smaller than axis by axis": some & np.logical_or(*wider),
        "more agree": some & (most > least[:, 0]),
        "all meet": most == boxes.shape[1],
        "empty": ~some,
        "empty, but not axis by axis": ~some
        & np.logical_and(*(s.any(axis=1) for s in sides.values())),
    }


def _within_each(boxes, k):
    at = boxes[..., k, None]
    return (boxes[:, None, :, k] <= at) & (at <= boxes[:, None, :, k + 1])


def _with(rows, n, q, **how):
    def inputs(rng):
        given = drawn(rng, 40 * rows, n, (q, q + 1), **how)
        return _rows(given, np.flatnonzero(want(given)["left"])[:rows])

    return inputs


def _points(rng):
    """Boxes of which two are single points, each within some of the others."""
    given = drawn(rng, 200)
    middle = given["boxes"][:, 2:4].reshape(-1, 2, 2, 2).mean(axis=3)
    given["boxes"][:, :2] = np.repeat(middle, 2, axis=2)
    known = want(given)
    needed = (known["outliers"][:, :2] == 0).any(axis=1) & (known["left"] > 0)
    return _rows(given, np.flatnonzero(needed)[:6])


def _box(given, out):
    right = want(given)
    same = np.abs(out["box"] - right["box"]).max(axis=1) <= CLOSE
    return (same & (out["left"] > 0)) | (right["left"] == 0)


def _outliers(given, out):
    right = want(given)
    same = (out["outliers"] == right["outliers"]).all(axis=1) & (out["left"] > 0)
    return same | (right["left"] == 0)


def _numbers(given):
    boxes, q = given["boxes"][0], given["q"][0]
    i, j = np.nonzero(_within(boxes, (0, 2)).sum(axis=2) >= len(boxes) - q)
    corners = np.unique(np.column_stack([boxes[i, 0], boxes[j, 2]]), axis=0)
    return {"all points (x_min of a box, y_min of a box) in at least n − q boxes": corners[None]}


def _law(name, points, says, holds, asks):
    return Law(name, points, says, holds, want=want, asks=asks, step=_numbers)


RELAXED = Task(
    id="10-relaxed",
    title="Measurements with outliers",
    call=CALLS["10-relaxed"],
    inputs=inputs,
    shapes=lambda given: {
        "left": (len(given["q"]),),
        "box": (len(given["q"]), 4),
        "outliers": given["boxes"].shape[:2],
    },
    laws=(
        _law(
            "box",
            2,
            "the box is the smallest one around all positions that are in at least n − q boxes",
            _box,
            "In how many boxes is the leftmost of these positions? On a side of which box is it?",
        ),
        _law(
            "outliers",
            1.5,
            "an outlier is certain if and only if its box contains none of these positions",
            _outliers,
            "Take a box that is not a certain outlier. At which position can the robot then be, "
            "and how many boxes contain this position?",
        ),
        _law(
            "empty",
            0.5,
            "relaxed returns None if no position is in at least n − q boxes, and only then",
            lambda given, out: out["left"] == want(given)["left"],
            "What is the largest number of boxes that have a position in common?",
        ),
    ),
    probes=(
        Probe("a single box", _with(3, 1, 0)),
        Probe("no outliers allowed", _with(4, 4, 0)),
        Probe("all boxes but one allowed to be outliers", _with(4, 5, 4)),
        Probe("boxes that are single points", _points),
        Probe("thirty boxes of which ten can be outliers", _with(3, 30, 10, size=(0.4, 1.2))),
    ),
    parts=lambda given, out: {
        "left": out["left"],
        "box": out["box"][want(given)["left"] > 0],
        "outliers": out["outliers"][want(given)["left"] > 0],
    },
    begins=(
        "Draw three boxes that meet in pairs, but not all at once. For q = 1, where can the robot "
        "be?",
        "Move along a line from left to right. At which places can the number of boxes change in "
        "which you are?",
    ),
)
