"""Task 12-paired: confidence interval of the median difference of two filters on the same runs."""

from itertools import accumulate
from math import comb

import numpy as np

from classroom.exercises.correctness_laws import ROUNDING, Diagnosis, equals
from classroom.exercises.task import Probe, Task
from course.exercises.ex12_three_filters.calls import CALLS

ROWS = 8


def studies(rng, drives=24, steps=25, stray=0.6, first=0.0, rows=ROWS):
    """Two filters with similar errors: errors_a, errors_b (rows, drives, steps), limit (rows,).
    stray, first : share of runs in which a filter strays, and of these at the first reading.
    """
    limit = rng.uniform(0.1, 0.3, rows)
    hard = limit[:, None, None] * rng.uniform(0.1, 0.5, (rows, drives, 1))
    a, b = (hard * rng.uniform(0.4, 1.8, (rows, drives, steps)) for _ in range(2))
    for errors in (a, b):
        errors *= rng.uniform(0.9, 1.1, (rows, drives, 1))
        for row, most in zip(errors, limit, strict=True):
            kept = rng.permutation(drives)[
                :6
            ]  # six runs in which no filter strays at the first reading
            for k, drive in enumerate(row):
                begin = rng.integers(1, max(steps - 1, 2))
                begin = 0 if k not in kept and rng.random() < first else begin
                away = drive[begin : begin + rng.integers(1, 6)]  # then it returns
                if rng.random() < stray and steps > 1:
                    away[:] = most * rng.uniform(1.1, 3, len(away))
    return {"errors_a": a, "errors_b": b, "limit": limit}


def _differences(i):
    both = np.stack([i["errors_a"], i["errors_b"]])
    alive = np.logical_and.accumulate((both <= i["limit"][:, None, None]).all(axis=0), axis=2)
    count = alive.sum(axis=2)
    a, b = np.sqrt((both**2 * alive).sum(axis=3) / np.maximum(count, 1))
    return [np.sort((x - y)[n > 0]) for x, y, n in zip(a, b, count, strict=True)]


def _with_calm_ones(rng):
    both = studies(rng), studies(rng, stray=0, rows=2)
    return {name: np.concatenate([some[name] for some in both]) for name in both[0]}


def _between(i, o):
    beyond = np.maximum(i["errors_a"], i["errors_b"]).max(axis=(1, 2)) > i["limit"]
    pairs = zip(_differences(i), o["result"], beyond, strict=True)
    off = [np.abs(ends - d[:, None]).min() for d, ends, away in pairs if not away]
    return min(off) > ROUNDING


def too_few(n):
    """How many numbers of heads, from 0 on, are too small for n coins."""
    return sum(sums <= 2**n / 40 for sums in accumulate(comb(n, k) for k in range(n + 1)))


def ends(i):
    """The interval of each study."""
    found = [(d, too_few(len(d))) for d in _differences(i)]
    return {"result": np.array([(d[few - 1], d[len(d) - few]) for d, few in found])}


def _step(i):
    d = _differences(i)[0]
    return {
        "sorted differences [m]": d,
        "runs that remain": len(d),
        "number of counts that are too small": too_few(len(d)),
    }


def _law(name, points, says, asks, **more):
    return equals(name, points, says, ends, asks=asks, step=_step, **more)


def _at_the_limit(rng):
    given = studies(rng, 9)
    for k in (0, 2, 5):
        given["errors_a"][:, k, 3] = given["errors_b"][:, k + 1, 4] = given["limit"]
    return given


def _both_at_once(rng):
    given = studies(rng, 12, stray=0)
    for drive, names in ((1, "ab"), (4, "a"), (6, "b"), (11, "b")):
        for name in names:
            given[f"errors_{name}"][:, drive, 0] = 2 * given["limit"]
    return given


def _whole(rng):
    return {
        "errors_a": np.array([[[3, 1], [1, 2], [5, 0], [4, 4], [2, 7], [6, 5], [7, 1]]]),
        "errors_b": np.array([[[1, 2], [1, 1], [0, 2], [3, 9], [3, 3], [2, 2], [1, 1]]]),
        "limit": np.array([8.0]),
    }


COIN, OUT = ("coins",), ("left out",)
PROBES = (
    *(
        Probe(
            f"{n} runs in which no filter strays",
            lambda rng, n=n: studies(rng, n, 6, 0, rows=3),
            COIN,
        )
        for n in (6, 7, 8, 9, 11, 12, 14, 17, 18, 25, 40, 80, 101)
    ),
    Probe("one reading per run", lambda rng: studies(rng, 13, 1), COIN),
    Probe(
        "runs in which one filter strays at the first reading",
        lambda rng: studies(rng, 30, first=0.5),
        OUT,
    ),
    Probe("a filter, or both, straying at the first reading", _both_at_once, OUT),
    Probe("errors that equal the limit", _at_the_limit),
    Probe("runs that stray late", lambda rng: studies(rng, 20, 60, stray=0.3)),
    Probe("whole numbers", _whole),
)


def _promised(i):
    """Whether at least six runs remain, and no two have the same difference."""
    return np.array([len(d) >= 6 and np.diff(d).min() > 1e-9 for d in _differences(i)])


PAIRED = Task(
    id="12-paired",
    title="Paired comparison of two filters",
    call=CALLS["12-paired"],
    inputs=_with_calm_ones,
    shapes={"result": (2,)},
    laws=(
        _law(
            "coins",
            2,
            "if no filter strays, the interval contains exactly the possible μ",
            "Let μ grow from the smallest difference on. At which μ does the number of differences "
            "below μ change, and which number is the first that is not too small?",
            main=False,
        ),
        _law(
            "until",
            2,
            "each run counts up to the reading before either filter strays",
            "In one run A strays at reading 7 and B at reading 4. Which readings of A count, and "
            "which of B? Does this change if A is within the limit again at reading 9?",
            after=("coins",),
        ),
        _law(
            "left out",
            1,
            "a run without a reading to compare is omitted, and not counted in n",
            "How many differences are there if some runs have no reading to compare?",
            main=False,
            after=("until",),
        ),
    ),
    diagnoses=(
        Diagnosis(
            "between-differences",
            "Your ends are not among the right differences, one for each run. Compare your "
            "differences with those above. The number of differences below μ changes only where μ "
            "passes one of them, so both ends are differences.",
            _between,
            asks="Which difference does a run have? How many of them lie between the ends of your "
            "interval, and can the number below μ change between two of them?",
        ),
    ),
    probes=PROBES,
    parts=lambda i, o: {"low": o["result"][:, 0], "high": o["result"][:, 1]},
    may_round=_promised,
    begins=(
        "One run: which readings of the two filters may you compare?",
        "Ten coins are thrown. How probable is it that at most one of them shows heads?",
    ),
)
