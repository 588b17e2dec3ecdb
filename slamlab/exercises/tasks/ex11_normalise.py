"""Exercise 11, normalise: weights by their ratios, whatever the size of their logarithms."""

import numpy as np

from slamlab.exercises.drives.ex11 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task

PLAIN, LOW, HIGH, SAMPLES = slice(0, 4), slice(4, 8), slice(8, 12), 20
ROWS = 12


def clouds(rng):
    """Logarithms of usual size, far below what a float's exponential can hold, and far above.

    The last ones lie far apart, too: what is far below the largest weighs nothing.

    ``weights`` are for ``effective_size``: equal ones on some of the samples, uneven ones.
    """
    logs = rng.uniform(-6, 0, (ROWS, SAMPLES))
    logs[PLAIN] += rng.uniform(-3, 3, (4, 1))
    logs[LOW] -= rng.uniform(2_000, 1e5, (4, 1))
    logs[HIGH] += rng.uniform(800, 5_000, (4, 1))
    logs[HIGH, : SAMPLES // 2] -= rng.uniform(2_000, 3_000, (4, 1))
    logs = rng.permuted(logs, axis=1)
    weights = rng.exponential(size=(ROWS, SAMPLES)) ** 2
    for k in range(6):
        weights[k] = rng.permutation(np.arange(SAMPLES) < rng.integers(1, SAMPLES - 1))
    return {"logs": logs, "weights": weights / weights.sum(axis=1, keepdims=True)}


def _sums(i, o):
    return (np.abs(o["logs"].sum(axis=1) - 1) < 1e-9)[PLAIN]


def _ratios(i, o, rows=PLAIN):
    """Whether w_a / w_b = exp(l_a − l_b), by the largest of each row."""
    logs, w = i["logs"][rows], o["logs"][rows]
    top = logs.argmax(axis=1)[:, None]
    want = np.exp(logs - np.take_along_axis(logs, top, 1)) * np.take_along_axis(w, top, 1)
    return ((np.abs(w - want) < 1e-9 * w.max(axis=1, keepdims=True)) & (w >= 0)).all(axis=1)


def _any_size(i, o):
    rows = slice(4, None)
    one = np.abs(o["logs"][rows].sum(axis=1) - 1) < 1e-9
    return (o["finite"][rows] > 0).all(axis=1) & one & _ratios(i, o, rows)


def _worth(i, o):
    """k equal weights are worth k; in general the size at which an average's noise is the same.

    The variance of a weighted mean of n independent numbers is Σ w² times theirs, and that of n_eff
    equal ones a share of 1/n_eff.
    """
    return np.abs(o["sizes"] * np.einsum("kn,kn->k", i["weights"], i["weights"]) - 1) < 1e-6


# ---- mistakes -------------------------------------------------------------------------------


def _broken(o, rows):
    """Whether in each of these rows something is no number, or all or none is zero."""
    w, finite = o["logs"][rows], o["finite"][rows]
    return ((finite == 0).any(axis=1) | (w == 0).any(axis=1)).all()


def _like(wrong):
    def matches(i, o):
        with np.errstate(all="ignore"):
            want = wrong(i["logs"][PLAIN])
        return np.abs(o["logs"][PLAIN] - want).max() < 1e-9 * np.abs(want).max()

    return matches


def _sized(name, hint, *wrong):
    def matches(i, o):
        return any(np.abs(o["sizes"] - w(i["weights"])).max() < 1e-6 * SAMPLES for w in wrong)

    return Diagnosis(name, hint, matches)


def _off_top(logs):
    return logs - logs.max(axis=1, keepdims=True)


def _softened(logs):
    return np.exp(logs) / (np.exp(logs).sum(axis=1, keepdims=True) + 1e-12)


NORMALISE = Task(
    id="11-normalise",
    title="Normalise, and count",
    drive=DRIVES["11-normalise"],
    inputs=clouds,
    shapes={"logs": (ROWS, SAMPLES), "finite": (ROWS, SAMPLES), "sizes": (ROWS,)},
    laws=(
        Law("sum", 0.5, "the weights sum to one", _sums),
        Law("ratios", 0.5, "their ratios are e to the difference of the logarithms", _ratios),
        Law(
            "any-size", 1, "so it is for logarithms of −100 000, of 5000, and far apart", _any_size
        ),
        Law("effective", 1, "k equal weights among zeros are worth k samples", _worth),
    ),
    diagnoses=(
        Diagnosis(
            "no-numbers",
            "Even logarithms of usual size give NaN or infinity: print what comes of [-1.0, -2.0].",
            lambda i, o: (o["finite"][PLAIN] == 0).any(),
        ),
        Diagnosis(
            "logs-divided",
            "You divide the logarithms by their sum. Weights are e to the logarithms; these are to "
            "be divided.",
            _like(lambda logs: logs / logs.sum(axis=1, keepdims=True)),
        ),
        Diagnosis(
            "over-the-largest",
            "You divide by the largest weight, so that one is 1. Divide by the sum.",
            _like(lambda logs: np.exp(_off_top(logs))),
        ),
        Diagnosis(
            "length-one",
            "Your weights have length one, √Σ w² = 1, as a vector has. Probabilities sum to one.",
            _like(lambda logs: np.exp(logs) / np.sqrt((np.exp(logs) ** 2).sum(1, keepdims=True))),
        ),
        Diagnosis(
            "not-normalised",
            "The ratios are right, but the weights do not sum to one: divide by their sum.",
            lambda i, o: _ratios(i, o).all() and not _sums(i, o).any(),
        ),
        Diagnosis(
            "underflow",
            "Logarithms of −2000 give weights that are no numbers, or zero: e⁻²⁰⁰⁰ is zero to a "
            "float, and 0/0 nothing. Only differences matter: take the largest logarithm off all "
            "of them before the exponential.",
            lambda i, o: _ratios(i, o).all() and _sums(i, o).all() and _broken(o, LOW),
        ),
        Diagnosis(
            "underflow-patched",
            "Logarithms of −2000 give equal weights, or other than they should: something was "
            "added so that nothing is divided by zero. Take the largest logarithm off instead; "
            "then the sum is never below one.",
            lambda i, o: (
                _ratios(i, o).all() and _sums(i, o).all() and not _any_size(i, o)[:4].any()
            ),
        ),
        Diagnosis(
            "overflow",
            "Logarithms of +2000 overflow: it is the largest logarithm that is to be taken off, "
            "not the smallest, nor a constant.",
            lambda i, o: _ratios(i, o).all() and not _any_size(i, o)[4:].any(),
        ),
        _sized(
            "inverted",
            "n_eff is 1 over the sum of the squares, not that sum: equal weights are worth n.",
            lambda w: (w**2).sum(axis=1),
        ),
        _sized(
            "squared-sum",
            "You square the sum, which is one. Square first, then sum: Σ w².",
            lambda w: 1 + 0 * w[:, 0],
        ),
        _sized(
            "counted",
            "You count the weights that are above zero. Uneven ones are worth less than their "
            "number: 1 / Σ w².",
            lambda w: (w > 0).sum(axis=1),
            lambda w: np.full(len(w), SAMPLES),
        ),
        _sized(
            "over-the-largest-weight",
            "1 over the largest weight is another measure. Here: 1 / Σ w².",
            lambda w: 1 / w.max(axis=1),
        ),
        _sized(
            "share",
            "That is a share of the n samples. Wanted is a number of samples, from 1 to n.",
            lambda w: 1 / (w**2).sum(axis=1) / SAMPLES,
        ),
        _sized(
            "root",
            "You take a root of the sum of squares: the weights' length. n_eff is 1 / Σ w².",
            lambda w: 1 / np.sqrt((w**2).sum(axis=1)),
        ),
    ),
)
