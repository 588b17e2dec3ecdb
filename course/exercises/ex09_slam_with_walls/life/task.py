"""Task 09-life: track management, scan after scan."""

import numpy as np

from classroom.exercises.correctness_laws import Law, once
from classroom.exercises.task import Probe, Task
from course.exercises.ex09_slam_with_walls.calls import CALLS, ids_of


def sequences(rng, rows=16, scans=10, walls=3, N=(1, 4), lives=(1, 4), names=9, seen=0.5, most=2):
    """Scans of ids in random order, padded with −1.
    seen : probability that a scan observes a wall; most : how often its id may occur in a scan.
    """
    table = np.full((rows, scans, most * walls), -1)
    for row in table:
        ids = rng.choice(names, walls, replace=False)
        for scan in row:
            held = ids[rng.random(walls) < seen]
            times = rng.choice([1, 1, most], len(held)) if most > 1 else 1
            held = rng.permutation(np.repeat(held, times))
            scan[: len(held)] = held
    return {"scans": table, "N": rng.integers(*N, rows), "lives": rng.integers(*lives, rows)}


def _gaps(rng):
    found = sequences(rng, 6, 12, 1, lives=(2, 4), most=1, seen=0.0)
    for row, lives, off in zip(found["scans"], found["lives"], (-1, 0, 1) * 2, strict=True):
        row[[0, 1, 2 + lives + off, 3 + lives + off], 0] = 0
    return found


@once
def truth(inputs):
    """The book after each scan, by counting: `lives` minus the scans since the last observation;
    the observations since the last gap of `lives` scans or more.
    """
    ids, (seen,) = ids_of(inputs["scans"]), _observed(inputs).values()
    found = {name: np.zeros(seen.shape) for name in ("inside", "left", "observations", "used")}
    for row, column in np.ndindex(ids.shape):
        lives, N = int(inputs["lives"][row]), int(inputs["N"][row])
        times = np.flatnonzero(seen[row, :, column])
        for k in range(seen.shape[1]):
            past, at = times[times <= k], (row, k, column)
            if not len(past) or k - past[-1] >= lives:
                continue
            deaths = np.flatnonzero(np.diff(past) > lives)
            since = len(past) - (deaths[-1] + 1 if len(deaths) else 0)
            found["inside"][at], found["left"][at] = 1, lives - (k - past[-1])
            found["observations"][at], found["used"][at] = since, seen[at] and since >= N
    return found


def _observed(inputs):
    """Whether the book has to count the id of each column in each scan, (n, scans, walls)."""
    ids = ids_of(inputs["scans"])
    seen = (inputs["scans"][..., None] == ids[:, None, None]).any(axis=2) & (ids >= 0)[:, None]
    return {"1 where the scan observes the wall of this column": seen}


def _gap(inputs):
    """Scans since the last observation, −1 before the first, (n, scans, walls)."""
    (seen,) = _observed(inputs).values()
    scan = np.arange(seen.shape[1])[:, None]
    last = np.maximum.accumulate(np.where(seen, scan, -1), axis=1)
    gap = np.where(last < 0, -1, scan - last)
    return {"scans since the last observation of each wall (−1: no observation yet)": gap}


def _while_inside(name):
    """Judge a count as long as the book has the right walls: a wrong book is judged already."""

    def holds(inputs, outputs):
        right = truth(inputs)
        agree = np.logical_and.accumulate(outputs["inside"] == right["inside"], axis=1)
        return ((outputs[name] == right[name]) | ~agree).all(axis=(1, 2))

    return holds


def _counts(name, says, asks, holds=None, **more):
    def same(inputs, outputs):
        return (outputs[name] == truth(inputs)[name]).all(axis=(1, 2))

    def want(inputs):
        return {name: truth(inputs)[name]}

    return Law(name, 1, says, holds or same, want=want, asks=asks, **more)


def _lives(inputs, outputs):
    # compared only for walls that are in the book and should be
    right = truth(inputs)
    same = (outputs["left"] == right["left"]) | (outputs["inside"] != right["inside"])
    return same.all(axis=(1, 2))


def _shapes(inputs):
    rows, scans, _ = inputs["scans"].shape
    walls = ids_of(inputs["scans"]).shape[1]
    return dict.fromkeys(("inside", "left", "observations", "used"), (rows, scans, walls))


LIFE = Task(
    id="09-life",
    title="Track management: observations and lives",
    call=CALLS["09-life"],
    inputs=sequences,
    probes=(
        Probe("a wall missed in about `lives` scans in a row", _gaps),
        Probe("`lives` = 1", lambda rng: sequences(rng, 4, 6, 2, lives=(1, 2))),
        Probe("N = 1", lambda rng: sequences(rng, 4, 5, 2, N=(1, 2))),
        Probe("empty scans", lambda rng: sequences(rng, 2, 5, 2, seen=0.0)),
        Probe("an id three times in a scan", lambda rng: sequences(rng, 3, 5, 2, most=3)),
        Probe("a dozen walls with any ids", lambda rng: sequences(rng, 2, 12, 12, names=1000)),
    ),
    shapes=_shapes,
    may_round=False,
    laws=(
        _counts(
            "inside",
            "a wall leaves the book when it is missed in `lives` scans in a row",
            "What happens to a wall with one life left when a scan misses or observes it?",
            step=_gap,
        ),
        _counts(
            "left",
            "a wall has `lives` lives minus the scans since its last observation",
            "How many lives does an observation restore, and how many does a miss cost?",
            _lives,
            alone=False,
            step=_gap,
        ),
        _counts(
            "observations",
            "a wall has one observation for each scan with its id since it entered the book",
            "How many observations does a scan add if it contains the id of a wall twice?",
            _while_inside("observations"),
            after=("inside",),
            step=_gap,
        ),
        _counts(
            "used",
            "`used` contains each wall of this scan with at least N observations, once",
            "Does the observation of this scan count? Can a wall be used without a measurement?",
            _while_inside("used"),
            after=("inside", "observations"),
            step=_observed,
        ),
    ),
    begins=(
        "The book is empty, N = 2, lives = 3, and the scan is [7, 4]. Which book and "
        "which list do you return?",
        "What do you do with the walls of the book that are not in seen?",
    ),
)
