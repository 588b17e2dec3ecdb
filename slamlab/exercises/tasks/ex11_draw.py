"""Exercise 11, draw: a comb gives each sample its share, rounded up or down, and is fair.

The band of fairness is seven standard deviations wide, so that chance fails nobody in 10⁶.
"""

import numpy as np

from slamlab.exercises.drives.ex11 import AGAIN, DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task

CLOUDS, SAMPLES, SEEDS = 2, 12, 250
BAND = 7.0  # standard deviations


def clouds(rng):
    """Uneven weights, none of which asks for (nearly) a whole number of copies."""
    weights = []
    while len(weights) < CLOUDS:
        w = rng.exponential(size=SAMPLES) ** 1.5 + 0.01
        w /= w.sum()
        rest = SAMPLES * w % 1
        largest_early = w.argmax() < SAMPLES - 1
        if rest.min() > 0.05 and rest.max() < 0.95 and w.max() > 0.2 and largest_early:
            weights.append(w)
    seeds = rng.permuted(np.arange(1, 100_000))[: CLOUDS * SEEDS].reshape(CLOUDS, SEEDS)
    return {"weights": np.array(weights), "seeds": seeds.astype(float)}


def _asked(i):
    return SAMPLES * i["weights"]


def _rounded(i, o):
    """(k, s) each sample gets its share rounded up or down, in every draw."""
    off = np.abs(o["copies"] - _asked(i)[:, None])
    return (off < 1 + 1e-9).all(axis=-1)


def _scores(i, o):
    """(k, n) how far mean copies over seeds stray, in standard deviations of a comb's."""
    rest = _asked(i) % 1
    sigma = np.sqrt(rest * (1 - rest) / SEEDS)
    return (o["copies"].mean(axis=1) - _asked(i)) / sigma


def _fair(i, o):
    # nearly whole shares are rare events: a normal band needs a few expected ones more
    return (np.abs(_scores(i, o)) < BAND).all(axis=1)


def _same_again(o):
    return (o["copies"][:, :AGAIN] == o["again"]).all(axis=(1, 2))


def _by_the_seed(i, o):
    return _same_again(o) & (np.ptp(o["copies"], axis=1) > 0).any(axis=1)


# ---- mistakes -------------------------------------------------------------------------------


def _variance(i, o):
    """(k, n) variances of the copies over seeds."""
    return o["copies"].var(axis=1)


def _always_largest(i, o):
    return (o["copies"].argmax(axis=-1) == i["weights"].argmax(axis=-1)[:, None]).all() and (
        o["copies"].max(axis=-1) == SAMPLES
    ).all()


def _one_for_all(i, o):
    return (o["copies"].max(axis=-1) == SAMPLES).all()


def _strays(i, o, times):
    """Whether copies stray as in independent draws, times a factor; the fair ones do."""
    w = i["weights"]
    want = SAMPLES * w * (1 - w)
    ratio = _variance(i, o).sum(axis=1) / want.sum(axis=1)
    return (np.abs(ratio / times - 1) < 0.2).all()


def _uniform(i, o):
    return (np.abs(o["copies"].mean(axis=1) - 1) < 0.35).all()


def _still(i, o):
    return (np.ptp(o["copies"], axis=1) == 0).all()


def _first_too_often(i, o):
    """The comb stands beside the rod: one end gains what another loses."""
    off = o["copies"].mean(axis=1) - _asked(i)
    return (np.abs(off[:, [0, -1]]).max(axis=1) > 0.25).all()


def _fair_on_the_whole(i, o):
    """Means right within the noise of independent draws."""
    w = i["weights"]
    sigma = np.sqrt(SAMPLES * w * (1 - w) / SEEDS)
    return (np.abs(o["copies"].mean(axis=1) - _asked(i)) < 6 * sigma).all()


DRAW = Task(
    id="11-draw",
    title="Draw, with a comb",
    drive=DRIVES["11-draw"],
    inputs=clouds,
    shapes={"copies": (CLOUDS, SEEDS, SAMPLES), "again": (CLOUDS, AGAIN, SAMPLES)},
    laws=(
        Law("share", 2, "each sample gets n w copies, rounded up or down, every time", _rounded),
        Law("fair", 1, "over many seeds each gets n w copies on average", _fair),
        Law("seed", 1, "the same seed draws the same, other seeds others", _by_the_seed),
    ),
    diagnoses=(
        Diagnosis(
            "another-generator",
            "The same seed draws other samples: draw from the rng that is passed in, none from "
            "np.random or a generator of your own.",
            lambda i, o: not _same_again(o).all(),
        ),
        Diagnosis(
            "largest-weight",
            "You take the sample with the largest weight, every time. That is the erratum of the "
            "thesis' algorithm 1: draw with a probability that is the weight.",
            _always_largest,
        ),
        Diagnosis(
            "one-draw",
            "One sample is drawn and copied n times. Each of the n teeth picks for itself.",
            _one_for_all,
        ),
        Diagnosis(
            "without-weights",
            "All samples are drawn alike often, whatever their weight.",
            _uniform,
        ),
        Diagnosis(
            "no-random-number",
            "Every seed draws the same: what is the random number that shifts the comb? Without it "
            "some samples would never get the copy that is due to them now and then.",
            _still,
        ),
        Diagnosis(
            "independent",
            "On average this is right, but the copies stray as those of n independent random "
            "numbers do. A comb has one random number for all its teeth.",
            lambda i, o: _strays(i, o, 1.0),
        ),
        Diagnosis(
            "stratified",
            "On average this is right, and calmer than independent draws, but the copies stray "
            "from n w by more than rounding: more than one random number is at work (one for each "
            "tooth is stratified drawing). A comb has one for all its teeth.",
            lambda i, o: _fair_on_the_whole(i, o) and not _rounded(i, o).all(),
        ),
        Diagnosis(
            "shifted",
            "The comb does not stand on the rod: on average the first or the last samples get too "
            "much. The teeth are at (u + k)/n, k from 0 to n − 1, u from 0 to 1.",
            _first_too_often,
        ),
    ),
)
