"""Task 11-draw: a comb gives each sample its share, rounded up or down, and is fair.

The band of fairness is seven standard deviations of the mean wide: a comb's where shares are
rounded, else those of the answer, which also tells whether copies come in heaps. Who draws right on
average, by a comb or by n tickets, is inside all but once in 10⁷ gradings (of 24 means the rarest
are binomial, with 15 copies due in all).
"""

import numpy as np

from slamlab.exercises.drives.ex11 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Probe, Task

CLOUDS, SAMPLES, SEEDS = 2, 12, 300
BAND = 7.0  # standard deviations
LATE, HAIR = 339728, 1e-9  # a seed whose first number is nearly one; what rounding may leave


def clouds(rng):
    """Uneven weights, none of which asks for (nearly) a whole number of copies."""
    weights = []
    for _ in range(10_000):
        w = rng.exponential(size=SAMPLES) ** 1.5 + 0.01
        w /= w.sum()
        rest = SAMPLES * w % 1
        largest_early = w.argmax() < SAMPLES - 1
        if rest.min() > 0.05 and rest.max() < 0.95 and w.max() > 0.2 and largest_early:
            weights.append(w)
        if len(weights) == CLOUDS:
            break
    return drawn(rng, weights, SEEDS)


def drawn(rng, weights, seeds):
    """Inputs: each row of weights, drawn from with seeds of its own."""
    many = rng.choice(10**6, (len(weights), seeds), replace=False) + 1.0
    return {"weights": np.array(weights), "seeds": many}


def _uneven(samples, zeros=0):
    def inputs(rng):
        weights = rng.exponential(size=(3, samples)) ** 2
        weights[:, :zeros] = 0
        weights = rng.permuted(weights, axis=1)
        return drawn(rng, weights / weights.sum(axis=1, keepdims=True), 20)

    return inputs


def _one_has_all(rng):
    return drawn(rng, np.eye(5)[[0, 2, 4]], 20)


def _hair(rng):
    """Weights whose sum is a hair below one, and a comb whose last tooth stands there."""
    weights = rng.uniform(0.5, 1.5, (1, 1000))
    weights[:, 0] = 0  # what is found nowhere must not become sample 0
    weights *= (1 - HAIR) / weights.sum()
    return {"weights": weights, "seeds": np.full((1, 1), float(LATE))}


def _asked(i):
    """(k, 1, n) the copies that the weights ask for."""
    return (i["weights"].shape[1] * i["weights"])[:, None]


def _rounded(i, o):
    """(k,) whether each sample gets its share rounded up or down, in every draw."""
    slack = 1e-9 + 2 * HAIR * i["weights"].shape[1]
    low, high = np.floor(_asked(i) + slack), np.ceil(_asked(i) - slack)
    return ((o["copies"] >= low) & (o["copies"] <= high)).all(axis=(1, 2))


def _strays(i, o):
    """(k, n) by how much the mean of the copies over all seeds is off."""
    return o["copies"].mean(axis=1) - _asked(i)[:, 0]


def _fair(i, o):
    rest = _asked(i)[:, 0] % 1
    comb = rest * (1 - rest)  # the variance of a share that is rounded up or down
    tickets = _asked(i)[:, 0] * (1 - i["weights"])
    strayed = o["copies"].var(axis=1)
    # a sample that was never drawn strays by nothing: what the others say of heaps holds for it
    heaps = strayed.sum(axis=1) / tickets.sum(axis=1)
    strayed = np.maximum(strayed, np.maximum(comb, heaps[:, None] * tickets))
    variance = np.where(_rounded(i, o)[:, None], comb, strayed)
    # nearly whole shares are rare events: a normal band needs a few expected ones more
    band = BAND * np.sqrt((variance + 0.01) / i["seeds"].shape[1])
    return (np.abs(_strays(i, o)) < band).all(axis=1)


def _same_again(o):
    return (o["copies"][:, : o["again"].shape[1]] == o["again"]).all(axis=(1, 2))


def _by_the_seed(i, o):
    differ = (np.ptp(o["copies"], axis=1) > 0).any(axis=1)
    return _same_again(o) & differ


def _why_seed(i, o):
    if not _same_again(o).all():
        return "Called again with a generator of the same seed, it drew other samples."
    return f"With {i['seeds'].shape[1]} seeds it drew the same samples each time."


def _why_share(i, o):
    k, _, n = np.unravel_index(np.abs(o["copies"] - _asked(i)).argmax(), o["copies"].shape)
    copies = o["copies"][k, :, n]
    return (
        f"Sample {n}, counted from 0, weighs {i['weights'][k, n]:.3f}: it is due to have "
        f"{_asked(i)[k, 0, n]:.2f} copies, and had {copies.min():.0f} to {copies.max():.0f} over "
        f"{len(copies)} seed{'' if len(copies) == 1 else 's'}."
    )


def _why_fair(i, o):
    k, n = np.unravel_index(np.abs(_strays(i, o)).argmax(), i["weights"].shape)
    return (
        f"Sample {n}, counted from 0, is due to have {_asked(i)[k, 0, n]:.2f} copies; over "
        f"{i['seeds'].shape[1]} seeds it had {o['copies'][k, :, n].mean():.2f} on average."
    )


# ---- mistakes of those who draw in another way than the solution ----------------------------


def _like_tickets(i, o):
    """Whether copies stray as those of n independent draws do."""
    w = i["weights"]
    want = (w.shape[1] * w * (1 - w)).sum()
    return abs(o["copies"].var(axis=1).sum() / want - 1) < 0.2


def _fair_on_the_whole(i, o):
    w = i["weights"]
    sigma = np.sqrt(w.shape[1] * w * (1 - w) / i["seeds"].shape[1])
    return (np.abs(_strays(i, o)) < 6 * sigma).all() and not _rounded(i, o).all()


DRAW = Task(
    id="11-draw",
    title="Draw, with a comb",
    drive=DRIVES["11-draw"],
    inputs=clouds,
    shapes=lambda i: {
        "copies": (*i["seeds"].shape, i["weights"].shape[1]),
        "again": (len(i["seeds"]), None, i["weights"].shape[1]),
    },
    laws=(
        Law(
            "share",
            2,
            "each sample gets n w copies, rounded up or down, every time",
            _rounded,
            why=_why_share,
            asks="Where does the first tooth stand, where the second, and which piece of the rod "
            "is below it?",
            step=lambda i: {"copies asked for": _asked(i)[:, 0]},
        ),
        Law(
            "fair",
            1,
            "over many seeds each gets n w copies on average",
            _fair,
            why=_why_fair,
            asks="Between which two numbers may the first tooth stand? Are all of them as likely?",
        ),
        Law(
            "seed",
            1,
            "the same seed draws the same, other seeds others",
            _by_the_seed,
            why=_why_seed,
            asks="Where does your random number come from, and how many of them do you take?",
            alone=False,
        ),
    ),
    diagnoses=(
        Diagnosis(
            "no-random-number",
            "Every seed draws the same: some samples would never get the copy that is due to them "
            "now and then.",
            lambda i, o: _same_again(o).all() and not np.ptp(o["copies"], axis=1).any(),
        ),
        Diagnosis(
            "another-generator",
            "The same seed draws other samples: draw from the rng that is passed in, none from "
            "np.random or a generator of your own.",
            lambda i, o: not _same_again(o).all(),
        ),
        Diagnosis(
            "without-weights",
            "All samples are drawn alike often, whatever their weight.",
            lambda i, o: (np.abs(o["copies"].mean(axis=1) - 1) < 0.35).all(),
        ),
        Diagnosis(
            "tickets",
            "On average this is right, but the copies stray as those of n independent random "
            "numbers do. A comb has one random number for all its teeth.",
            lambda i, o: _fair_on_the_whole(i, o) and _like_tickets(i, o),
        ),
        Diagnosis(
            "several-numbers",
            "On average this is right, and calmer than tickets, but the copies stray from n w by "
            "more than rounding: more than one random number is at work.",
            _fair_on_the_whole,
        ),
    ),
    probes=(
        Probe("one sample", lambda rng: drawn(rng, np.ones((2, 1)), 20), ("share",)),
        Probe("two samples", _uneven(2), ("share",)),
        Probe("many samples", _uneven(400), ("share",)),
        Probe("samples of weight zero", _uneven(9, 5), ("share",)),
        Probe("equal weights", lambda rng: drawn(rng, np.full((2, 10), 0.1), 20), ("share",)),
        Probe("one sample that has all the weight", _one_has_all, ("share",)),
        Probe("weights whose sum is a hair below one", _hair, ("share",)),
    ),
    rounds=False,
)
