"""Task 15-cell: a cell of a map hears of another scan, and stays able to change its mind."""

import numpy as np

from slamlab.exercises.drives.ex15 import DRIVES
from slamlab.exercises.law import Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex15_weight import same_numbers

FREELY, CLAMPED = 12, 8  # cells that stay within the bounds, and cells that would leave them


def heard(rng):
    """Log odds of cells, what a scan alone says, and the bound; the last cells reach it."""
    most = rng.uniform(0.9, 0.98, FREELY + CLAMPED)
    says = np.where(
        rng.uniform(size=len(most)) < 0.5,
        rng.uniform(0.6, 0.85, len(most)),
        rng.uniform(0.15, 0.4, len(most)),
    )
    bound, step = odds(most), odds(says)
    l = rng.uniform(-0.9, 0.9, len(most)) * (bound - np.abs(step))
    far = rng.uniform(0.1, 0.8, len(most))  # the share of the step that still fits in
    l[FREELY:] = (np.sign(step) * (bound - far * np.abs(step)))[FREELY:]
    says[FREELY : FREELY + 2] = 0.7, 0.3  # one of each at the least
    l[FREELY : FREELY + 2] = np.array([1, -1]) * (bound[FREELY : FREELY + 2] - 0.3)
    return {"l": l, "p": says, "most": most}


def odds(p):
    """Log odds of a probability."""
    return np.log(p / (1 - p))


def probability(l):
    """The probability that log odds stand for."""
    return 1 / (1 + np.exp(-l))


# ---- laws -----------------------------------------------------------------------------------


def bayes(inputs):
    """What Bayes' rule makes of two independent sayings."""
    before, says = probability(inputs["l"]), inputs["p"]
    return before * says / (before * says + (1 - before) * (1 - says))


def _same(got, want):
    return np.abs(got - want) < 1e-6


def _believes(inputs, outputs):
    return _same(probability(outputs["result"]), bayes(inputs))[:FREELY]


def _stops(inputs, outputs):
    most = inputs["most"]
    want = np.clip(bayes(inputs), 1 - most, most)
    return _same(probability(outputs["result"]), want)[FREELY:]


# ---- mistakes -------------------------------------------------------------------------------


def _clamped(l, inputs):
    return np.clip(l, -odds(inputs["most"]), odds(inputs["most"]))


def _wrong(name, hint, *formulas):
    """A wrong sum, clamped or not."""
    both = [f for formula in formulas for f in (formula, lambda i, g=formula: _clamped(g(i), i))]
    return same_numbers(name, hint, *both)


def _sum(i):
    return i["l"] + odds(i["p"])


MISTAKES = (
    same_numbers(
        "not-clamped",
        "There is no bound: a wall that was seen a thousand times would have to be missed for two "
        "thousand before the map believes it.",
        _sum,
    ),
    same_numbers(
        "one-side",
        "Only one side is bounded. A cell that was free a thousand times has to be able to become "
        "a wall, too.",
        lambda i: np.minimum(_sum(i), odds(i["most"])),
        lambda i: np.maximum(_sum(i), -odds(i["most"])),
    ),
    same_numbers(
        "bound-not-log-odds",
        "The bound is a probability, l are log odds: turn the bound into log odds before you "
        "compare.",
        lambda i: np.clip(_sum(i), -i["most"], i["most"]),
        lambda i: np.clip(_sum(i), 1 - i["most"], i["most"]),
    ),
    _wrong(
        "probability-added",
        "A probability was added to log odds. Turn what the scan says into log odds first: "
        "log p/(1 − p).",
        lambda i: i["l"] + i["p"],
        lambda i: i["l"] + i["p"] - 0.5,
        lambda i: i["l"] + np.log(i["p"]),
        lambda i: i["l"] + i["p"] / (1 - i["p"]),
    ),
    _wrong(
        "sign",
        "The cell learns the opposite: a scan that says p > 1/2 makes it *more* occupied. Look at "
        "what stands on top of the fraction.",
        lambda i: i["l"] - odds(i["p"]),
    ),
    _wrong(
        "other-base",
        "Another logarithm: log odds are natural ones, np.log.",
        lambda i: i["l"] + np.log10(i["p"] / (1 - i["p"])),
        lambda i: i["l"] + np.log2(i["p"] / (1 - i["p"])),
    ),
    _wrong(
        "forgets",
        "What was believed before is gone: the scan's log odds are added to l.",
        lambda i: odds(i["p"]),
    ),
    _wrong(
        "averaged",
        "Two sayings that agree make each other stronger: log odds are added, not averaged.",
        lambda i: (i["l"] + odds(i["p"])) / 2,
    ),
    same_numbers(
        "probability",
        "This is the probability. Asked for are its log odds: l after the scan.",
        bayes,
        lambda i: np.clip(bayes(i), 1 - i["most"], i["most"]),
    ),
    same_numbers(
        "unchanged",
        "l comes back as it went in.",
        lambda i: i["l"],
    ),
)

CELL = Task(
    id="15-cell",
    title="A cell changes its mind",
    drive=DRIVES["15-cell"],
    inputs=heard,
    shapes={"result": ()},
    laws=(
        Law("bayes", 2, "within the bounds the cell believes what Bayes' rule says", _believes),
        Law("clamped", 1, "no cell is believed more occupied, or more free, than `most`", _stops),
    ),
    diagnoses=MISTAKES,
)
