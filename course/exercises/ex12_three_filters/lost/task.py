"""Task 12-lost: since when a run has been lost."""

import numpy as np

from classroom.exercises.correctness_laws import Law
from classroom.exercises.task import Probe, Task
from course.exercises.ex12_three_filters.calls import CALLS


def runs(rng, count=26, steps=40):
    """Runs that never stray, return, are lost later, or from the start: errors (count, steps),
    limit (count,). No error equals its limit.
    """
    limit = rng.uniform(0.08, 0.3, count)
    near, far = (
        limit[:, None] * rng.uniform(*of, (count, steps)) for of in ((0.1, 0.95), (1.05, 4))
    )
    away, kinds = np.zeros((count, steps), dtype=bool), rng.permutation(np.arange(count) % 5)
    for row, kind in zip(away, kinds, strict=True):
        begin, length = rng.integers(steps // 10, steps // 3), rng.integers(2, steps // 5)
        row[begin : begin + length] = kind > 0  # kind 1 returns
        row[rng.integers(steps * 3 // 5, steps - 2) :] |= kind in (2, 3)
        row |= kind == 4
    return {"errors": np.where(away, far, near), "limit": limit}


def since(i):
    """The start of the readings at the end whose errors all exceed the limit."""
    far = i["errors"] > i["limit"][:, None]
    gone = np.logical_and.accumulate(far[:, ::-1], axis=1).sum(axis=1)
    return {"result": np.where(gone > 0, far.shape[1] - gone, -1)}


def _law(name, points, says, which, asks):
    def holds(i, o):
        right = since(i)["result"]
        return (o["result"] == right) | ~which(right)

    return Law(name, points, says, holds, want=since, asks=asks, step=_far)


def _far(i):
    return {"readings above the limit": np.flatnonzero(i["errors"][0] > i["limit"][0])}


def _of(*errors, whole=False):
    return lambda rng: {
        "errors": np.array(errors, dtype=int if whole else float),
        "limit": np.full(len(errors), 2.0 if whole else 1.0),
    }


PROBES = (
    Probe("one reading", _of([0.5], [2.0], [0.3])),
    Probe("two readings", _of([0.5, 0.6], [2.0, 3.0], [0.3, 2.0], [2.0, 0.4])),
    Probe("a run that is lost at its last reading only", _of([0.2, 0.3, 0.5, 2], [2, 3, 0.5, 4])),
    Probe(
        "a run that is within the limit at its first reading only",
        _of([0.2, 3.1, 2.2, 1.5, 2], [0.1, 2, 4, 3, 2.5]),
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
    title="Since when is a run lost?",
    call=CALLS["12-lost"],
    inputs=runs,
    shapes={"result": ()},
    laws=(
        _law(
            "stays",
            1,
            "a run that ends within the limit is not lost: −1",
            lambda right: right < 0,
            "Which single reading decides whether a run is lost?",
        ),
        _law(
            "since",
            3,
            "from your reading on all errors exceed the limit; the error before it does not",
            lambda right: right > 0,
            "Go back from the end: which is the last reading whose error is within the limit, and "
            "which number has the next reading?",
        ),
        _law(
            "always",
            1,
            "a run whose errors all exceed the limit is lost since reading 0",
            lambda right: right == 0,
            "What does your code search for, and what is the result if there is none?",
        ),
    ),
    probes=PROBES,
    begins=(
        "Which reading decides whether a run is lost at all?",
        "In a lost run: which is the last reading whose error is within the limit?",
    ),
)
