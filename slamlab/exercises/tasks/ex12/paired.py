"""Task 12-paired: the interval of the median difference of two filters on the same drives."""

from itertools import accumulate
from math import comb

import numpy as np

from slamlab.exercises.drives.ex12 import DRIVES
from slamlab.exercises.law import ROUNDING, Diagnosis, equals
from slamlab.exercises.task import Probe, Task

ROWS = 8


def studies(rng, drives=24, steps=25, stray=0.6, first=0.0, rows=ROWS):
    """Studies of two filters: hard and easy drives, on which both are about equally far off.

    Parameters
    ----------
    rng : numpy.random.Generator
    drives, steps, rows : int, drives of a study, readings of a drive, studies
    stray, first : float, in which share of the drives a filter strays, and does at once

    Returns
    -------
    dict of errors_a, errors_b (rows, drives, steps), limit (rows,)
    """
    limit = rng.uniform(0.1, 0.3, rows)
    hard = limit[:, None, None] * rng.uniform(0.1, 0.5, (rows, drives, 1))
    a, b = (hard * rng.uniform(0.4, 1.8, (rows, drives, steps)) for _ in range(2))
    for errors in (a, b):
        errors *= rng.uniform(0.9, 1.1, (rows, drives, 1))
        for row, most in zip(errors, limit, strict=True):
            kept = rng.permutation(drives)[:6]  # six drives that nobody loses at once
            for k, drive in enumerate(row):
                begin = rng.integers(1, max(steps - 1, 2))
                begin = 0 if k not in kept and rng.random() < first else begin
                away = drive[begin : begin + rng.integers(1, 6)]  # then it comes back
                if rng.random() < stray and steps > 1:
                    away[:] = most * rng.uniform(1.1, 3, len(away))
    return {"errors_a": a, "errors_b": b, "limit": limit}


def _differences(i):
    """The differences of each study's drives, in order of size."""
    both = np.stack([i["errors_a"], i["errors_b"]])
    alive = np.logical_and.accumulate((both <= i["limit"][:, None, None]).all(axis=0), axis=2)
    count = alive.sum(axis=2)
    a, b = np.sqrt((both**2 * alive).sum(axis=3) / np.maximum(count, 1))
    return [np.sort((x - y)[n > 0]) for x, y, n in zip(a, b, count, strict=True)]


def _with_calm_ones(rng):
    """Studies of which some have no drive on which a filter strays."""
    both = studies(rng), studies(rng, stray=0, rows=2)
    return {name: np.concatenate([some[name] for some in both]) for name in both[0]}


def _between(i, o):
    """Whether no end is a difference, although on these drives nobody strays."""
    beyond = np.maximum(i["errors_a"], i["errors_b"]).max(axis=(1, 2)) > i["limit"]
    pairs = zip(_differences(i), o["result"], beyond, strict=True)
    off = [np.abs(ends - d[:, None]).min() for d, ends, away in pairs if not away]
    return min(off) > ROUNDING


def too_few(n):
    """How many of the numbers 0, 1, … of heads are too few for n coins."""
    return sum(sums <= 2**n / 40 for sums in accumulate(comb(n, k) for k in range(n + 1)))


def ends(i):
    """The interval of each study."""
    found = [(d, too_few(len(d))) for d in _differences(i)]
    return {"result": np.array([(d[few - 1], d[len(d) - few]) for d, few in found])}


def _step(i):
    d = _differences(i)[0]
    return {
        "differences in order [m]": d,
        "drives left": len(d),
        "too few below μ": too_few(len(d)),
    }


def _law(name, points, says, asks, **more):
    return equals(name, points, says, ends, asks=asks, step=_step, **more)


def _at_the_limit(rng):
    """Some errors equal the limit, which is not beyond it."""
    given = studies(rng, 9)
    for k in (0, 2, 5):
        given["errors_a"][:, k, 3] = given["errors_b"][:, k + 1, 4] = given["limit"]
    return given


def _both_at_once(rng):
    """Drives that both filters lose at the first reading, A only, B only."""
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
            f"{n} drives on which nobody strays",
            lambda rng, n=n: studies(rng, n, 6, 0, rows=3),
            COIN,
        )
        for n in (6, 7, 8, 9, 11, 12, 14, 17, 18, 25, 40, 80, 101)
    ),
    Probe("one reading a drive", lambda rng: studies(rng, 13, 1), COIN),
    Probe("drives that one filter loses at once", lambda rng: studies(rng, 30, first=0.5), OUT),
    Probe("a filter, or both, lost at the first reading", _both_at_once, OUT),
    Probe("errors that equal the limit", _at_the_limit),
    Probe("drives that stray late", lambda rng: studies(rng, 20, 60, stray=0.3)),
    Probe("whole numbers", _whole),
)


def _promised(i):
    """(k,) whether six drives are left, no two of which have the same difference."""
    return np.array([len(d) >= 6 and np.diff(d).min() > 1e-9 for d in _differences(i)])


PAIRED = Task(
    id="12-paired",
    title="Two filters on the same drives",
    drive=DRIVES["12-paired"],
    inputs=_with_calm_ones,
    shapes={"result": (2,)},
    laws=(
        _law(
            "coins",
            2,
            "where nobody strays, the ends are those of all medians that are possible",
            "Let μ grow from the smallest difference on. When does the number of differences below "
            "μ change, and which number is the first that is not too few?",
            main=False,
        ),
        _law(
            "until",
            2,
            "each drive counts up to the reading before either filter strays",
            "On one drive A strays at reading 7 and B at reading 4. Which readings of A count, and "
            "which of B? And if A is near again at reading 9?",
            after=("coins",),
        ),
        _law(
            "left out",
            1,
            "a drive that has no such reading is left out, of n as well",
            "How many coins were thrown, if some drives say nothing?",
            main=False,
            after=("until",),
        ),
    ),
    diagnoses=(
        Diagnosis(
            "between-differences",
            "Your ends are none of the differences. How many of these lie below μ changes "
            "only where μ passes one of them, so both ends are differences: there is no bell to "
            "lay over them, and nothing to draw at random.",
            _between,
        ),
    ),
    probes=PROBES,
    parts=lambda i, o: {"low": o["result"][:, 0], "high": o["result"][:, 1]},
    rounds=_promised,
)
