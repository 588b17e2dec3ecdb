"""Task 16-versions: paired comparison of the errors of two versions in the same worlds."""

import numpy as np
from scipy import stats

from classroom.exercises.correctness_laws import Diagnosis, Law, once
from classroom.exercises.task import Probe, Task
from course.exercises.ex16_your_own_slam.calls import CALLS, VERDICTS

TAIL, MOST = 0.975, 1000  # probability of the quantile; largest value of needed
NEAR = 5e-4  # allowed error, relative to the half-width: t quantiles with three decimals
NEEDED = np.array([-3, -2, -1, 0, 0, 1, 1, 2, 2, 3, 9, 50])  # further worlds for a verdict


def width(n):
    """Half-width of the 95 % t interval of a mean of n numbers, in their standard deviations."""
    return stats.t.ppf(TAIL, n - 1) / np.sqrt(n)


def studies(rng, common=6, alone=(2, 3), needed=None, ordered=False, numbers=60):
    """Worlds (rows, n) and errors [m] of two versions, with ``common`` worlds of both.

    alone : number of further worlds of A and of B. needed : number of worlds that are needed for a
    verdict, in each row; the mean is negative in every second row, and in no other. ordered : all
    worlds in the same order."""
    needed = NEEDED + common if needed is None else needed
    found = {name: [] for name in ("worlds_a", "errors_a", "worlds_b", "errors_b")}
    for k, size in enumerate(np.maximum(needed, 2)):
        least, most = width(size), width(size - 1) if size > 2 else 1.7 * width(2)
        mean = (-1) ** k * np.sqrt(least * most)  # in standard deviations
        d = rng.standard_normal(common)
        d = mean + (d - d.mean()) / d.std(ddof=1)
        d *= np.exp(rng.uniform(*np.log([0.03, 0.8]))) / np.hypot(1, mean)
        worlds = rng.choice(numbers, common + sum(alone), replace=False)
        errors = 0.1 * np.exp(rng.normal(0, 0.7, len(worlds)))  # worlds differ more than versions
        of_a = np.arange(common + alone[0])
        of_b = np.append(np.arange(common), np.arange(len(of_a), len(worlds)))
        for name, kept in (("a", of_a), ("b", of_b)):
            kept = kept if ordered else rng.permutation(kept)
            factors = np.exp(np.where(kept < common, np.resize(d, len(worlds))[kept], 0))
            found[f"worlds_{name}"].append(worlds[kept])
            found[f"errors_{name}"].append(errors[kept] * (factors if name == "a" else 1))
    return {name: np.array(rows) for name, rows in found.items()}


def _as_before(rng):
    return studies(rng, 7, (0, 0), ordered=True)


def _too_many(rng):
    return studies(rng, 5, needed=[2 * MOST, 3 * MOST])


@once
def differences(inputs):
    """Differences ln(error of A / error of B) in the worlds of both, (rows, n)."""
    found = []
    for worlds_a, errors_a, worlds_b, errors_b in zip(*inputs.values(), strict=True):
        of_b = dict(zip(worlds_b.tolist(), errors_b, strict=True))
        both = [(e, of_b[k]) for k, e in zip(worlds_a.tolist(), errors_a, strict=True) if k in of_b]
        found.append(np.subtract(*np.log(both).T))
    return np.array(found)


@once
def want(inputs):
    d = differences(inputs)
    mean, s, halves = d.mean(axis=1), d.std(axis=1, ddof=1), width(np.arange(2, MOST))
    half = s * width(d.shape[1])
    return {
        "low": np.exp(mean - half),
        "high": np.exp(mean + half),
        "better": np.select([mean < -half, mean > half], [0.0, 1.0], 2.0),  # index in VERDICTS
        "needed": 2.0 + np.sum(s[:, None] * halves >= np.abs(mean)[:, None], axis=1),
    }


def _of(*names):
    return lambda inputs: {name: want(inputs)[name] for name in names}


def _half(inputs):
    right = want(inputs)
    return np.log(right["high"] / right["low"]) / 2


def _interval_holds(inputs, outputs):
    off = [np.abs(np.log(outputs[end] / want(inputs)[end])) for end in ("low", "high")]
    return np.max(off, axis=0) <= NEAR * _half(inputs)


def _needed_holds(inputs, outputs):
    n, d = outputs["needed"], differences(inputs)
    effect = np.abs(d.mean(axis=1)) / d.std(axis=1, ddof=1)
    enough = ((1 - NEAR) * width(n) < effect) | (n == MOST)
    too_few = (n == 2) | ((1 + NEAR) * width(np.maximum(n - 1, 2)) >= effect)
    return np.isin(n, np.arange(2, MOST + 1)) & enough & too_few


def _pairs(inputs):
    d = differences(inputs)[0]
    found = {"number of worlds of both": len(d), "mean of d": d.mean()}
    return found | {"standard deviation of d": d.std(ddof=1)}


def _mean(inputs):
    d, half = differences(inputs), _half(inputs)
    return {"mean of d": d.mean(axis=1), "its interval, ±": half}


def _halves(inputs):
    s, sizes = differences(inputs)[0].std(ddof=1), np.array([2, 5, 20, 100])
    return _mean(inputs) | {"worlds": sizes, "interval with so many worlds, ±": s * width(sizes)}


def _too_narrow(inputs, outputs):
    """Whether the intervals are in the right place, but narrower than those of t."""
    low, high, d = np.log(outputs["low"]), np.log(outputs["high"]), differences(inputs)
    shift = np.abs((low + high) / 2 - d.mean(axis=1)) / _half(inputs)
    share = (high - low) / 2 / _half(inputs)
    return (shift < 0.4).all() and 0.5 < np.median(share) < 0.9


def _promised(inputs):
    """Whether all errors are positive, and no verdict or number is a close decision."""
    d = differences(inputs)
    mean, s = np.abs(d.mean(axis=1)), d.std(axis=1, ddof=1)
    n = want(inputs)["needed"]
    clear = np.array([np.abs(mean / s / width(n - k) - 1) > NEAR for k in (0, 1)])
    clear |= np.array([n == MOST, n == 2])
    return np.all(clear, axis=0) & (s > 0)


VERSIONS = Task(
    id="16-versions",
    title="Compare two versions in the same worlds",
    call=CALLS["16-versions"],
    inputs=studies,
    shapes=dict.fromkeys(("low", "high", "better", "needed"), (None,)),
    laws=(
        Law(
            "interval",
            1,
            "low and high are the ends of the 95 % t interval of the factor in the worlds of both",
            _interval_holds,
            _of("low", "high"),
            asks="Which worlds contribute a number, how many numbers are there, and from which of "
            "them is their standard deviation estimated?",
            step=_pairs,
        ),
        Law(
            "better",
            0.5,
            f"better names a version only if the interval excludes 1: {', '.join(VERDICTS)}",
            lambda inputs, outputs: outputs["better"] == want(inputs)["better"],
            _of("better"),
            asks="Which factors are possible, by your interval? What do they say about A and B?",
            step=_mean,
        ),
        Law(
            "needed",
            0.5,
            "needed is the smallest number of worlds whose interval would exclude 1",
            _needed_holds,
            _of("needed"),
            asks="Which quantities in the half-width of your interval change with the number of "
            "worlds, and which of them stay the same?",
            step=_halves,
        ),
    ),
    diagnoses=(
        Diagnosis(
            "too-narrow",
            "Your interval is too narrow: neither a percentile bootstrap nor a normal distribution "
            "accounts for a standard deviation that is estimated from few numbers. Use t.",
            _too_narrow,
            asks="With only five numbers, how often would your interval contain the true mean? "
            "Compare with the table in the lesson.",
        ),
    ),
    probes=(
        Probe("two worlds of both", lambda rng: studies(rng, 2, needed=[2, 2, 3, 9])),
        Probe("three worlds of both", lambda rng: studies(rng, 3, needed=[2, 3, 3, 4, 5, 6])),
        Probe("the same worlds in the same order", _as_before),
        Probe("forty worlds of both", lambda rng: studies(rng, 40, needed=[38, 40, 41, 42, 90])),
        Probe("hundreds of worlds needed", lambda rng: studies(rng, 9, needed=[100, 200, 300])),
        Probe("more than a thousand worlds needed", _too_many, ("needed",)),
        Probe("large numbers of worlds", lambda rng: studies(rng, 4, numbers=2**31)),
    ),
    may_round=_promised,
    begins=(
        "One world is hard for both versions, another one is easy for both. In which number of a "
        "world does this cancel out?",
        "Take three worlds in which A's error is 0.9, 0.8 and 0.7 times that of B. What are the "
        "mean and the standard deviation of the logarithms, and how uncertain is this mean?",
    ),
)
