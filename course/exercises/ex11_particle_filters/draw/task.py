"""Task 11-draw: systematic resampling rounds each n w up or down and is unbiased."""

import numpy as np

from classroom.exercises.correctness_laws import Diagnosis, Law
from classroom.exercises.references import Reference
from classroom.exercises.task import Probe, Task
from course.exercises.ex11_particle_filters.calls import CALLS

CLOUDS, SAMPLES, SEEDS = 2, 12, 300
# standard deviations of the mean, those of systematic resampling where copies are rounded, else the
# answer's own; an unbiased draw is outside once in 10⁷ gradings (24 means, the rarest binomial)
BAND = 7.0
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
    """Inputs: each row of weights has its own seeds."""
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
    weights = rng.uniform(0.5, 1.5, (1, 1000))
    weights[:, 0] = 0  # a position on no piece must not select particle 0
    weights *= (1 - HAIR) / weights.sum()
    return {"weights": weights, "seeds": np.full((1, 1), float(LATE))}


def _asked(i):
    """(k, 1, n) expected numbers of copies, n w."""
    return (i["weights"].shape[1] * i["weights"])[:, None]


def _rounded(i, o):
    slack = 1e-9 + 2 * HAIR * i["weights"].shape[1]
    low, high = np.floor(_asked(i) + slack), np.ceil(_asked(i) - slack)
    return ((o["copies"] >= low) & (o["copies"] <= high)).all(axis=(1, 2))


def _strays(i, o):
    """(k, n) errors of the mean copies over all seeds."""
    return o["copies"].mean(axis=1) - _asked(i)[:, 0]


def _fair(i, o):
    rest = _asked(i)[:, 0] % 1
    comb = rest * (1 - rest)  # the variance of a share that is rounded up or down
    tickets = _asked(i)[:, 0] * (1 - i["weights"])
    strayed = o["copies"].var(axis=1)
    # the variance of a particle that was never drawn is 0: take the ratio of the others for it
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
        return "A second call with the same seed drew other particles."
    return (
        f"With {i['seeds'].shape[1]} different seeds, your function always drew the same particles."
    )


def _why_share(i, o):
    k, _, n = np.unravel_index(np.abs(o["copies"] - _asked(i)).argmax(), o["copies"].shape)
    copies = o["copies"][k, :, n]
    return (
        f"Particle {n}, counted from 0, has the weight w = {i['weights'][k, n]:.3f}, so n w = "
        f"{_asked(i)[k, 0, n]:.2f}. It had {copies.min():.0f} to {copies.max():.0f} copies over "
        f"{len(copies)} seed{'' if len(copies) == 1 else 's'}."
    )


def _why_fair(i, o):
    k, n = np.unravel_index(np.abs(_strays(i, o)).argmax(), i["weights"].shape)
    return (
        f"Particle {n}, counted from 0, should have n w = {_asked(i)[k, 0, n]:.2f} copies on "
        f"average; over {i['seeds'].shape[1]} seeds its mean was {o['copies'][k, :, n].mean():.2f}."
    )


# ---- mistakes of answers that draw in another way than the solution ----------------------------


def _like_tickets(i, o):
    w = i["weights"]
    want = (w.shape[1] * w * (1 - w)).sum()
    return abs(o["copies"].var(axis=1).sum() / want - 1) < 0.2


def _fair_on_the_whole(i, o):
    w = i["weights"]
    sigma = np.sqrt(w.shape[1] * w * (1 - w) / i["seeds"].shape[1])
    return (np.abs(_strays(i, o)) < 6 * sigma).all() and not _rounded(i, o).all()


def _systematic(i):
    weights, first = i["weights"][0], i["rng"][0]
    teeth = (first + np.arange(weights.size)) / weights.size
    found = np.searchsorted(np.cumsum(weights), teeth, side="right")
    return {"result": np.minimum(found, weights.size - 1)[None]}


def _copies(i):
    return {"expected number of copies, n w": _asked(i)[:, 0]}


def _shift(i):
    first = np.random.default_rng(int(i["seeds"][0, 0])).random()
    return {"a uniform random number of the first seed": np.array([first])}


DRAW = Task(
    id="11-draw",
    title="Systematic resampling",
    call=CALLS["11-draw"],
    inputs=clouds,
    shapes=lambda i: {
        "copies": (*i["seeds"].shape, i["weights"].shape[1]),
        "again": (len(i["seeds"]), None, i["weights"].shape[1]),
    },
    laws=(
        Law(
            "share",
            2,
            "each particle gets n w copies, rounded up or down, for every seed",
            _rounded,
            why=_why_share,
            asks="Where on the line is the first position? At which distances do the other "
            "positions follow? Which segment contains each position?",
            step=_copies,
        ),
        Law(
            "fair",
            1,
            "over many seeds each particle gets n w copies on average",
            _fair,
            why=_why_fair,
            asks="A particle has n w = 0.3. In which share of the draws must it get a copy? Which "
            "random number decides about it in your code, and which distribution has it?",
            step=_copies,
        ),
        Law(
            "seed",
            1,
            "the same seed gives the same indices, and other seeds give other indices",
            _by_the_seed,
            why=_why_seed,
            asks="Which generator gives your random number?",
            alone=False,
            step=_shift,
        ),
    ),
    diagnoses=(
        Diagnosis(
            "no-random-number",
            "Every seed gives the same indices, so the numbers of copies are biased. Shift all "
            "positions by one random number.",
            lambda i, o: _same_again(o).all() and not np.ptp(o["copies"], axis=1).any(),
            asks="How many different random numbers shift your positions? Do you get the same "
            "indices for every seed?",
        ),
        Diagnosis(
            "another-generator",
            "Two calls with the same seed draw different particles. Use the rng that is passed "
            "in, not np.random and not your own generator.",
            lambda i, o: not _same_again(o).all(),
            asks="From which generator does your random number come?",
        ),
        Diagnosis(
            "without-weights",
            "You draw all particles equally often, independently of their weights.",
            lambda i, o: (np.abs(o["copies"].mean(axis=1) - 1) < 0.35).all(),
            asks="How often do you draw a particle whose weight is zero?",
        ),
        Diagnosis(
            "tickets",
            "The mean numbers of copies are right, but their variances are the variances of "
            "multinomial resampling. Systematic resampling uses one random number for all "
            "positions.",
            lambda i, o: _fair_on_the_whole(i, o) and _like_tickets(i, o),
            asks="How many random numbers do you use for n positions?",
        ),
        Diagnosis(
            "several-numbers",
            "The mean numbers of copies are right, but some copies differ from n w by more than "
            "rounding. Use one random number for all positions.",
            _fair_on_the_whole,
            asks="How many random numbers do you use for n positions?",
        ),
    ),
    probes=(
        Probe("one particle", lambda rng: drawn(rng, np.ones((2, 1)), 20), ("share",)),
        Probe("two particles", _uneven(2), ("share",)),
        Probe("many particles", _uneven(400), ("share",)),
        Probe("particles of weight zero", _uneven(9, 5), ("share",)),
        Probe("equal weights", lambda rng: drawn(rng, np.full((2, 10), 0.1), 20), ("share",)),
        Probe("one particle that has all the weight", _one_has_all, ("share",)),
        Probe("weights whose sum is slightly below one", _hair, ("share",)),
    ),
    may_round=False,
    references=(Reference("draw", "weights rng", _systematic),),
    begins=(
        "Put segments of the lengths of the weights on a line from 0 to 1. Which "
        "segment contains the point 0.5?",
        "At which distance must n positions follow each other on a line of length 1?",
    ),
)
