"""Task 12-interval: confidence interval of a share, judged by its coverage."""

from functools import cache

import numpy as np
from scipy.stats import beta, binom

from classroom.exercises.correctness_laws import Diagnosis, Law
from classroom.exercises.task import Probe, Task
from course.exercises.ex12_three_filters.calls import CALLS

SHARES = np.linspace(0.02, 0.98, 193)
SLACK = 1e-9  # rounding of numbers up to 1
# Right intervals differ (Wilson, Clopper-Pearson, Agresti-Coull, Jeffreys). For all tested numbers
# of runs, their mean coverage is at least 0.949, and at most that of Clopper-Pearson; the least
# coverage of a share is 0.79 with one run, 0.86 with forty. Their width at 0 of n is 0.67 to 1.3
# times that of Clopper-Pearson.
LEAST, CAUTIOUS, ENDS = 0.94, 0.002, (0.6, 1.5)


def counts(*runs):
    """All counts k for these numbers of runs, in random order."""

    def inputs(rng):
        pairs = np.array([(k, n) for n in runs for k in range(n + 1)])
        k, n = pairs[rng.permutation(len(pairs))].T
        return {"k": k, "n": n}

    return inputs


def _tables(i, o):
    """Bounds (n + 1, 2) by number of runs."""
    rows = {n: np.flatnonzero(i["n"] == n) for n in sorted(set(i["n"].tolist()))}
    return {n: o["result"][at[np.argsort(i["k"][at])]] for n, at in rows.items()}


@cache
def _chances(n):
    return binom.pmf(np.arange(n + 1)[:, None], n, SHARES)


def coverage(bounds):
    """(shares,) probability that the interval contains the true share."""
    held = (bounds[:, :1] <= SHARES) & (bounds[:, 1:] >= SHARES)
    return np.sum(held * _chances(len(bounds) - 1), axis=0)


@cache
def _most(n):
    """Mean coverage of the Clopper-Pearson interval, the most conservative one."""
    k = np.arange(n + 1)
    low = np.where(k > 0, beta.ppf(0.025, np.maximum(k, 1), n - k + 1), 0)
    return coverage(np.column_stack([low, 1 - low[::-1]])).mean()


def _observed(i):
    k, n, z = i["k"][:1], i["n"][:1], 1.96
    return {
        "k/n": k / n,
        "largest possible standard deviation of k/n": np.sqrt(0.25 / n),
        "coefficients of p², p and 1 in the quadratic inequality": np.array(
            [1 + z**2 / n, -(2 * k + z**2) / n, (k / n) ** 2]
        )[:, 0],
    }


def _inside(i, o):
    low, high = o["result"].T
    share = i["k"] / i["n"]
    return (low >= -SLACK) & (low <= share + SLACK) & (share - SLACK <= high) & (high <= 1 + SLACK)


def _why_inside(i, o):
    k, n, (low, high) = i["k"][0], i["n"][0], o["result"][0]
    return f"The interval is {low:.6g} to {high:.6g}, and k/n is {k} / {n} = {k / n:.6g}."


def _doubtful(i, o):
    k, n = i["k"], i["n"]
    wide = np.diff(o["result"], axis=1)[:, 0] / (1 - 0.025 ** (1 / n))
    return ((wide > ENDS[0]) & (wide < ENDS[1])) | ((k > 0) & (k < n))


def _why_doubtful(i, o):
    k, n, (low, high) = i["k"][0], i["n"][0], o["result"][0]
    p = 1 - 0.025 ** (1 / n)
    return (
        f"If the true share is {p if k == 0 else 1 - p:.3g}, {k} of {n} still has a probability of "
        f"2.5 %. Your interval is {low:.3g} to {high:.3g}."
    )


def _least(n):
    return 0.86 if n >= 20 else 0.78


def _honest(n, c):
    return LEAST < c.mean() < _most(n) + CAUTIOUS and c.min() > _least(n)


def _covers(i, o):
    return [_honest(n, coverage(bounds)) for n, bounds in _tables(i, o).items()]


def _why_covers(i, o):
    found = {n: coverage(bounds) for n, bounds in _tables(i, o).items()}
    found = {n: c for n, c in found.items() if not _honest(n, c)}
    n, c = max(found.items(), key=lambda pair: abs(pair[1].mean() - 0.95) + 0.95 - pair[1].min())
    return (
        f"With {n} run{'s' * (n > 1)} the mean coverage is {100 * c.mean():.1f} %. The smallest "
        f"coverage is {100 * c.min():.1f} %, at p = {100 * SHARES[np.argmin(c)]:.1f} %."
    )


def _pairs(i, o):
    """Widths for the same share of n and of 4 n runs, without shares near 0 or 1."""
    wide = dict(zip(zip(i["k"], i["n"], strict=True), np.diff(o["result"])[:, 0], strict=True))
    some = [(k, n) for k, n in wide if (4 * k, 4 * n) in wide and 4 <= k <= n - 4]
    return np.array([(k, n, wide[k, n], wide[4 * k, 4 * n]) for k, n in some])


def _narrows(i, o):
    few, many = _pairs(i, o)[:, 2:].T
    return (many > 0.4 * few) & (many < 0.6 * few)


def _why_narrows(i, o):
    pairs = _pairs(i, o)
    k, n, few, many = pairs[np.argmax(np.abs(pairs[:, 3] / np.maximum(pairs[:, 2], 1e-12) - 0.5))]
    return (
        f"The width of the interval is {few:.3g} for {k:.0f} of {n:.0f}, and {many:.3g} for "
        f"{4 * k:.0f} of {4 * n:.0f}."
    )


def _certain(i, o):
    of_none, of_all = (o["result"][i["k"] == k] for k in (0, i["n"]))
    return (np.abs(of_none) < SLACK).all() or (np.abs(of_all - 1) < SLACK).all()


def _in_steps(i, o):
    steps = 1e4 * o["result"]
    return len(np.unique(steps)) > 8 and (np.abs(steps - np.round(steps)) < 1e-5).all()


INTERVAL = Task(
    id="12-interval",
    title="Confidence interval of a share",
    call=CALLS["12-interval"],
    inputs=counts(40, 160),
    shapes={"result": (2,)},
    laws=(
        Law(
            "inside",
            1,
            "0 ≤ low ≤ k/n ≤ high ≤ 1",
            _inside,
            why=_why_inside,
            asks="Can a share be below 0 or above 1? And is p = k/n always possible?",
            step=_observed,
        ),
        Law(
            "doubt",
            1,
            "for 0 of n and n of n, the width is 0.6 to 1.5 times 1 − 0.025^(1/n)",
            _doubtful,
            why=_why_doubtful,
            asks="None of six runs was lost. How probable is this if the true share is one in ten?",
            step=_observed,
        ),
        Law(
            "covers",
            2,
            "the mean coverage is above 94 %, and at most 0.2 percentage points above that of the "
            "Clopper–Pearson interval; the smallest is above 86 % (78 % if n < 20)",
            _covers,
            why=_why_covers,
            asks="Is the variance in your formula p (1 − p)/n of the true share p, or that of the "
            "observed share k/n? For which p is the difference largest?",
            step=_observed,
        ),
        Law(
            "narrows",
            1,
            "with n and k four times as large, the width is 0.4 to 0.6 times as large",
            _narrows,
            why=_why_narrows,
            asks="How does the standard deviation of k/n depend on n?",
            step=_observed,
        ),
    ),
    diagnoses=(
        Diagnosis(
            "drawn-from-the-count",
            "Your interval for 0 of n, or for n of n, is a single point. Does your formula use the "
            "observed share as p? A result of 0 of n is also possible if p is above 0.",
            _certain,
            asks="Which interval does your function give for 0 of 20? Is a true share of 1 % "
            "possible then?",
        ),
        Diagnosis(
            "in-steps",
            "All your ends are multiples of 0.0001 or of a larger step. Did you round them, or try "
            "p on a grid? With very many runs the whole interval is narrower than a step.",
            _in_steps,
            asks="How wide is your interval for one million runs? With how many decimals do "
            "you give its ends?",
        ),
    ),
    probes=(
        Probe("few runs", counts(1, 2, 3, 6), ("inside", "doubt", "covers")),
        Probe("eighty runs", counts(80), ("inside", "doubt", "covers")),
        Probe(
            "very many runs",
            lambda rng: {
                "k": np.array([0, 0, 30_000, 120_000, 7, 28, 100_000, 399_997]),
                "n": np.array([100_000, 400_000] * 4),
            },
            ("inside", "doubt", "narrows"),
        ),
    ),
    parts=lambda i, o: {"low": o["result"][:, 0], "high": o["result"][:, 1]},
    begins=(
        "The true share is p. Which standard deviation does the observed share of n runs have?",
        "For which p is k/n exactly 1.96 standard deviations away from p?",
    ),
)
