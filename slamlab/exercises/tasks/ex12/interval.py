"""Task 12-interval: how sure a share is, judged by how often the interval holds the true one."""

from functools import cache

import numpy as np
from scipy.stats import beta, binom

from slamlab.exercises.drives.ex12 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Probe, Task

SHARES = np.linspace(0.02, 0.98, 193)
SLACK = 1e-9  # rounding of numbers up to 1
# Right forms differ (Wilson, Clopper and Pearson, Agresti and Coull, Jeffreys). Of all numbers of
# runs that are tried: their mean coverage is 0.949 at least, and Clopper and Pearson's at most; no
# share is covered less than 0.79 with one run, 0.86 with forty. Their width at 0 of n is 0.67 to
# 1.3 of Clopper and Pearson's.
LEAST, CAUTIOUS, ENDS = 0.94, 0.002, (0.6, 1.5)


def counts(*runs):
    """Every count there is of so many runs, in random order: nothing is left to luck."""

    def inputs(rng):
        pairs = np.array([(k, n) for n in runs for k in range(n + 1)])
        k, n = pairs[rng.permutation(len(pairs))].T
        return {"k": k, "n": n}

    return inputs


def _tables(i, o):
    """Number of runs to the bounds (n + 1, 2) of 0, 1, … of them."""
    rows = {n: np.flatnonzero(i["n"] == n) for n in sorted(set(i["n"].tolist()))}
    return {n: o["result"][at[np.argsort(i["k"][at])]] for n, at in rows.items()}


@cache
def _chances(n):
    """(n + 1, shares) how likely each count is with each true share."""
    return binom.pmf(np.arange(n + 1)[:, None], n, SHARES)


def coverage(bounds):
    """(shares,) probability that the interval of what is counted holds the true share."""
    held = (bounds[:, :1] <= SHARES) & (bounds[:, 1:] >= SHARES)
    return np.sum(held * _chances(len(bounds) - 1), axis=0)


@cache
def _most(n):
    """Mean coverage of the most cautious interval, Clopper and Pearson's."""
    k = np.arange(n + 1)
    low = np.where(k > 0, beta.ppf(0.025, np.maximum(k, 1), n - k + 1), 0)
    return coverage(np.column_stack([low, 1 - low[::-1]])).mean()


def _inside(i, o):
    low, high = o["result"].T
    share = i["k"] / i["n"]
    return (low >= -SLACK) & (low <= share + SLACK) & (share - SLACK <= high) & (high <= 1 + SLACK)


def _why_inside(i, o):
    k, n, (low, high) = i["k"][0], i["n"][0], o["result"][0]
    return f"The interval is {low:.6g} to {high:.6g}, and {k} of {n} are {k / n:.6g}."


def _doubtful(i, o):
    k, n = i["k"], i["n"]
    wide = np.diff(o["result"], axis=1)[:, 0] / (1 - 0.025 ** (1 / n))
    return ((wide > ENDS[0]) & (wide < ENDS[1])) | ((k > 0) & (k < n))


def _why_doubtful(i, o):
    k, n, (low, high) = i["k"][0], i["n"][0], o["result"][0]
    p = 1 - 0.025 ** (1 / n)
    return (
        f"{k} of {n} would still happen in one study of forty if the true share were "
        f"{p if k == 0 else 1 - p:.3g}; yours says {low:.3g} to {high:.3g}."
    )


def _least(n):
    return 0.86 if n >= 20 else 0.78


def _honest(n, c):
    """Whether the coverage of intervals of n runs is about 95 %, whatever the true share is."""
    return LEAST < c.mean() < _most(n) + CAUTIOUS and c.min() > _least(n)


def _covers(i, o):
    return [_honest(n, coverage(bounds)) for n, bounds in _tables(i, o).items()]


def _why_covers(i, o):
    found = {n: coverage(bounds) for n, bounds in _tables(i, o).items()}
    found = {n: c for n, c in found.items() if not _honest(n, c)}
    n, c = max(found.items(), key=lambda pair: abs(pair[1].mean() - 0.95) + 0.95 - pair[1].min())
    return (
        f"With {n} run{'s' * (n > 1)} it holds the true share in {100 * c.mean():.1f} % of the "
        f"studies on average, and in {100 * c.min():.1f} % if that share is "
        f"{100 * SHARES[np.argmin(c)]:.1f} %."
    )


def _pairs(i, o):
    """Widths of the same share of n and of 4 n runs, where it is neither rare nor usual."""
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
        f"Of {k:.0f} in {n:.0f} the interval is {few:.3g} wide, of {4 * k:.0f} in {4 * n:.0f} "
        f"{many:.3g}."
    )


def _certain(i, o):
    """Whether 0 of n, or n of n, is taken for certain."""
    of_none, of_all = (o["result"][i["k"] == k] for k in (0, i["n"]))
    return (np.abs(of_none) < SLACK).all() or (np.abs(of_all - 1) < SLACK).all()


def _in_steps(i, o):
    """Whether all ends are whole ten-thousandths, and yet many numbers."""
    steps = 1e4 * o["result"]
    return len(np.unique(steps)) > 8 and (np.abs(steps - np.round(steps)) < 1e-5).all()


INTERVAL = Task(
    id="12-interval",
    title="How sure is a share?",
    drive=DRIVES["12-interval"],
    inputs=counts(40, 160),
    shapes={"result": (2,)},
    laws=(
        Law(
            "inside",
            1,
            "0 ≤ low ≤ k/n ≤ high ≤ 1",
            _inside,
            why=_why_inside,
            asks="Can a share be below 0 or above 1? And is the share that was counted possible?",
        ),
        Law(
            "doubt",
            1,
            "0 of n and n of n leave a doubt of a few n-ths",
            _doubtful,
            why=_why_doubtful,
            asks="Of six runs none was lost. How likely is that if the true share is one in ten?",
        ),
        Law(
            "covers",
            2,
            "it holds the true share in about 95 % of all studies, whatever that share is",
            _covers,
            why=_why_covers,
            asks="Whose scatter stands in your formula, that of the true share or that of the one "
            "that was counted? Where is the difference largest?",
        ),
        Law(
            "narrows",
            1,
            "four times the runs make it half as wide",
            _narrows,
            why=_why_narrows,
            asks="How does the scatter of k/n depend on n?",
        ),
    ),
    diagnoses=(
        Diagnosis(
            "drawn-from-the-count",
            "0 of n is taken for certain, or n of n: who draws from the share that was counted, "
            "or lets that share scatter, never sees there what was not counted.",
            _certain,
        ),
        Diagnosis(
            "in-steps",
            "All your ends are whole thousandths, or the like: they were rounded, or shares were "
            "tried in such steps. With very many runs the whole interval is narrower than a step.",
            _in_steps,
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
)
