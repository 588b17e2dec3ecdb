"""Task 12-interval: how sure a share is, judged by how often the interval holds the true one."""

import numpy as np
from scipy.stats import binom

from slamlab.exercises.drives.ex12 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task

Z = 1.959964
RUNS = 40, 160
SHARES = np.linspace(0.02, 0.98, 193)


def counts(rng):
    """Every count there is of 40 and of 160 runs, in random order: nothing is left to luck."""
    pairs = np.array([(k, n) for n in RUNS for k in range(n + 1)])
    k, n = pairs[rng.permutation(len(pairs))].T
    return {"k": k, "n": n}


def sorted_bounds(inputs, outputs, runs):
    """(runs + 1, 2) the intervals of 0, 1, … of so many runs."""
    rows = np.flatnonzero(inputs["n"] == runs)
    return outputs["result"][rows[np.argsort(inputs["k"][rows])]]


def coverage(bounds, shares=SHARES):
    """(len(shares),) probability that the interval of what is counted holds the true share."""
    runs = len(bounds) - 1
    held = (bounds[:, :1] <= shares) & (shares <= bounds[:, 1:])
    return np.sum(held * binom.pmf(np.arange(runs + 1)[:, None], runs, shares), axis=0)


def _inside(inputs, outputs):
    low, high = outputs["result"].T
    share, slack = inputs["k"] / inputs["n"], 1e-9
    return (-slack <= low) & (low <= share + slack) & (share - slack <= high) & (high <= 1 + slack)


def _doubtful(inputs, outputs):
    """Nobody and everybody leave a doubt of about 3 / n, not none."""
    k, n = inputs["k"], inputs["n"]
    wide = np.diff(outputs["result"], axis=1)[:, 0]
    ends = (k == 0) | (k == n)
    return ((wide > 1.5 / n) & (wide < 8 / n))[ends]


def _covers(inputs, outputs):
    """For both numbers of runs: 95 % on average over all shares, and hardly less for any."""
    found = [coverage(sorted_bounds(inputs, outputs, n)) for n in RUNS]
    return [0.935 < c.mean() < 0.985 and c.min() > 0.82 for c in found]


def _narrows(inputs, outputs):
    few, many = (np.diff(sorted_bounds(inputs, outputs, n), axis=1)[:, 0] for n in RUNS)
    ratio = many[::4] / np.maximum(few, 1e-12)  # the same share of four times as many runs
    return (ratio[4:-4] > 0.4) & (ratio[4:-4] < 0.6)


# ---- mistakes: intervals that students write -----------------------------------------------------


def wilson(k, n, z=Z):
    """The middle and half the width of Wilson's interval."""
    p, grown = k / n, 1 + z**2 / n
    middle = (p + z**2 / (2 * n)) / grown
    return middle, z * np.sqrt(p * (1 - p) / n + z**2 / (4 * n**2)) / grown


def wald(k, n, z=Z):
    return k / n, z * np.sqrt(k / n * (1 - k / n) / n)


def variance(k, n):
    return k / n, Z * (k / n) * (1 - k / n) / n


def of_one_run(k, n):
    return k / n, Z * np.sqrt(k / n * (1 - k / n))


def one_sigma(k, n):
    return wilson(k, n, 1.0)


def one_sigma_wald(k, n):
    return wald(k, n, 1.0)


def not_moved(k, n):
    return k / n, wilson(k, n)[1]


def undivided(k, n):
    middle, half = wilson(k, n)
    grown = 1 + Z**2 / n
    return middle * grown, half * grown


HINTS = {
    "wald": (
        "p ± 1.96 √(p (1 − p) / n) puts the *counted* share where the true one belongs. At 0 of n "
        "it claims certainty, and for small shares it misses far too often. Ask for all true "
        "shares that are at most 1.96 of *their own* deviations from what was counted.",
        (wald,),
    ),
    "variance": (
        "p (1 − p) / n is a variance. An interval is made of standard deviations: take the root.",
        (variance,),
    ),
    "of-one-run": (
        "√(p (1 − p)) is how much *one* run scatters. The share of n runs scatters √n less.",
        (of_one_run,),
    ),
    "one-sigma": (
        "This is one standard deviation to either side: it holds the truth in 68 % of all "
        "studies. 95 % take 1.96.",
        (one_sigma, one_sigma_wald),
    ),
    "not-moved": (
        "The width is right, but the interval sits round the counted share. Its middle lies "
        "nearer to one half: (p + z²/2n) / (1 + z²/n).",
        (not_moved,),
    ),
    "undivided": (
        "Middle and width still have to be divided by 1 + z²/n.",
        (undivided,),
    ),
}


def _made_by(*formulas):
    """Whether the bounds are those of a formula, cut off at 0 and 1 or not."""

    def matches(inputs, outputs):
        for formula in formulas:
            middle, half = formula(inputs["k"], inputs["n"])
            bounds = np.column_stack([middle - half, middle + half])
            for wrong in (bounds, np.clip(bounds, 0, 1)):
                if np.allclose(outputs["result"], wrong, atol=2e-3):
                    return True
        return False

    return matches


INTERVAL = Task(
    id="12-interval",
    title="How sure is a share?",
    drive=DRIVES["12-interval"],
    inputs=counts,
    shapes={"result": (2,)},
    laws=(
        Law("inside", 1, "0 ≤ low ≤ k/n ≤ high ≤ 1", _inside),
        Law("doubt", 1, "0 of n and n of n leave a doubt of a few n-ths", _doubtful),
        Law(
            "covers",
            2,
            "it holds the true share in about 95 % of all studies, whatever that share is",
            _covers,
        ),
        Law("narrows", 1, "four times the runs make it half as wide", _narrows),
    ),
    diagnoses=tuple(
        Diagnosis(name, hint, _made_by(*formulas)) for name, (hint, formulas) in HINTS.items()
    ),
)
