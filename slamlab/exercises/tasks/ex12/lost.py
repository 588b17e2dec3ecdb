"""Task 12-lost: from when on a run is lost for good, judged by what the word means."""

import numpy as np

from slamlab.exercises.drives.ex12 import DRIVES
from slamlab.exercises.law import Law
from slamlab.exercises.task import Probe, Task


def runs(rng, count=26, steps=40):
    """Runs that never stray, that stray and come back, that stray, come back and are lost, that are
    lost from the start on; none meets its limit exactly.

    Parameters
    ----------
    rng : numpy.random.Generator
    count, steps : int, runs and readings of each

    Returns
    -------
    dict of errors (count, steps), limit (count,)
    """
    limit = rng.uniform(0.08, 0.3, count)
    near, far = (
        limit[:, None] * rng.uniform(*of, (count, steps)) for of in ((0.1, 0.95), (1.05, 4))
    )
    away, kinds = np.zeros((count, steps), dtype=bool), rng.permutation(np.arange(count) % 5)
    for row, kind in zip(away, kinds, strict=True):
        begin, length = rng.integers(steps // 10, steps // 3), rng.integers(2, steps // 5)
        row[begin : begin + length] = kind > 0  # kind 1 comes back
        row[rng.integers(steps * 3 // 5, steps - 2) :] |= kind in (2, 3)
        row |= kind == 4
    return {"errors": np.where(away, far, near), "limit": limit}


def since(i):
    """The dates, from behind: so many readings at the end that no near one follows."""
    far = i["errors"] > i["limit"][:, None]
    gone = np.logical_and.accumulate(far[:, ::-1], axis=1).sum(axis=1)
    return {"result": np.where(gone > 0, far.shape[1] - gone, -1)}


def _law(name, points, says, which, asks):
    """The dates of some of the runs are right."""

    def holds(i, o):
        right = since(i)["result"]
        return (o["result"] == right) | ~which(right)

    return Law(name, points, says, holds, want=since, asks=asks, step=_far)


def _far(i):
    return {"readings beyond the limit": np.flatnonzero(i["errors"][0] > i["limit"][0])}


def _of(*errors, whole=False):
    """Runs with a limit of 1, or of 2 in whole numbers, that are the same for every seed."""
    return lambda rng: {
        "errors": np.array(errors, dtype=int if whole else float),
        "limit": np.full(len(errors), 2.0 if whole else 1.0),
    }


PROBES = (
    Probe("one reading", _of([0.5], [2.0], [0.3])),
    Probe("two readings", _of([0.5, 0.6], [2.0, 3.0], [0.3, 2.0], [2.0, 0.4])),
    Probe("a run that is lost with its last reading", _of([0.2, 0.3, 0.5, 2], [2, 3, 0.5, 4])),
    Probe(
        "a run that is near at the begin only", _of([0.2, 3.1, 2.2, 1.5, 2], [0.1, 2, 4, 3, 2.5])
    ),
    Probe(
        "an error that equals the limit",
        _of([2, 1, 3, 4], [1, 1, 1, 1], [2, 3, 4, 1], [1, 2, 2, 3]),
    ),
    Probe("whole numbers", _of([1, 3, 2, 3, 4], [3, 3, 4, 5, 3], [0, 4, 1, 0, 2], whole=True)),
    Probe("a long run", lambda rng: runs(rng, 5, 400)),
)

LOST = Task(
    id="12-lost",
    title="Lost, and since when",
    drive=DRIVES["12-lost"],
    inputs=runs,
    shapes={"result": ()},
    laws=(
        _law(
            "stays",
            1,
            "a run that never strays, or comes back, is not lost: −1",
            lambda right: right < 0,
            "Which single reading tells you whether a run is lost at all?",
        ),
        _law(
            "since",
            3,
            "from the date on all errors are beyond the limit, and the one before was not",
            lambda right: right > 0,
            "Walk back from the end: which is the last reading that is still near, and what number "
            "has the one after it?",
        ),
        _law(
            "always",
            1,
            "a run that is never near is lost since 0",
            lambda right: right == 0,
            "What does your code look for, and what does it get when there is none of it?",
        ),
    ),
    probes=PROBES,
)
