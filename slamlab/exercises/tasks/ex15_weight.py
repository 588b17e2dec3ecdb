"""Task 15-weight: what an edge still counts that cannot be true."""

from functools import partial

import numpy as np

from slamlab.exercises.drives.ex15 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task

HALF = 10  # edges below Φ, and as many beyond
STEP = 1e-5


def doubted(rng):
    """χ² of edges, the first half below Φ, and Φ."""
    phi = rng.uniform(4, 14, 2 * HALF)
    share = np.concatenate([rng.uniform(0.05, 0.9, HALF), np.exp(rng.uniform(0.3, 4, HALF))])
    return {"chi2": share * phi, "phi": phi}


def cost(chi2, phi):
    """ρ as the notebook has it."""
    return np.where(chi2 <= phi, chi2, 3 * phi - 4 * phi**2 / (phi + chi2))


def slope(inputs):
    """∂ρ/∂χ² by differences: what H and b are to be multiplied with."""
    chi2, phi = inputs["chi2"], inputs["phi"]
    h = STEP * chi2
    return (cost(chi2 + h, phi) - cost(chi2 - h, phi)) / (2 * h)


def _same(rows):
    def holds(inputs, outputs):
        want = slope(inputs)
        return (np.abs(outputs["result"] - want) < 1e-4 * want)[rows]

    return holds


# ---- mistakes -------------------------------------------------------------------------------


def _s(inputs):
    return 2 * inputs["phi"] / (inputs["phi"] + inputs["chi2"])


def _limited(s):
    return np.minimum(1, s)


FAR = np.s_[HALF:]


def same_numbers(name, hint, *formulas, rows=np.s_[:]):
    """A diagnosis: the numbers that came back, or some of them, are those of a wrong formula.

    Parameters
    ----------
    name, hint : str
    formulas : inputs -> (n,)
    rows : slice, the inputs looked at
    """

    def matches(inputs, outputs):
        got = outputs["result"][rows]
        return any(np.allclose(got, f(inputs)[rows], rtol=1e-6, atol=1e-9) for f in formulas)

    return Diagnosis(name, hint, matches)


_beyond = partial(same_numbers, rows=FAR)

MISTAKES = (
    _beyond(
        "not-squared",
        "This is s. The information is scaled by s², which is the slope of ρ.",
        _s,
    ),
    same_numbers(
        "unlimited",
        "An edge that fits well counts more than one that is trusted: s is never above 1.",
        lambda i: _s(i) ** 2,
        _s,
    ),
    _beyond(
        "cut-off",
        "Beyond Φ the edge is thrown away. Its weight falls with χ², but it never vanishes: an "
        "edge that looked false at first may come back.",
        lambda i: np.zeros(len(i["chi2"])),
    ),
    _beyond(
        "root-of-chi2",
        "χ² comes in as it is, the square of a distance: do not take its root, and do not square "
        "it again.",
        lambda i: _limited(2 * i["phi"] / (i["phi"] + np.sqrt(i["chi2"]))) ** 2,
        lambda i: _limited(2 * i["phi"] / (i["phi"] + i["chi2"] ** 2)) ** 2,
    ),
    _beyond(
        "two-missing",
        "s has a 2 on top: at χ² = Φ it has to be 1.",
        lambda i: (_s(i) / 2) ** 2,
        lambda i: _s(i) / 2,
    ),
    _beyond(
        "other-kernel",
        "This is the weight of another kernel (Huber's, Cauchy's …). Here it is to be the slope of "
        "the ρ that is given.",
        lambda i: i["phi"] / i["chi2"],
        lambda i: np.sqrt(i["phi"] / i["chi2"]),
        lambda i: (i["phi"] / i["chi2"]) ** 2,
        lambda i: 1 / (1 + i["chi2"] / i["phi"]) ** 2,
    ),
    _beyond(
        "cost-for-weight",
        "This is what the edge costs. Asked for is the factor of its information, between 0 and 1.",
        lambda i: cost(i["chi2"], i["phi"]),
        lambda i: _s(i) ** 2 * i["chi2"],
    ),
    _beyond(
        "always-trusted",
        "Every edge counts in full: beyond Φ the weight has to fall.",
        lambda i: np.ones(len(i["chi2"])),
    ),
)

WEIGHT = Task(
    id="15-weight",
    title="What a doubtful edge counts",
    drive=DRIVES["15-weight"],
    inputs=doubted,
    shapes={"result": ()},
    laws=(
        Law("trusted", 1, "up to Φ an edge counts in full: 1", _same(np.s_[:HALF])),
        Law("doubted", 2, "beyond Φ its weight is the slope of ρ", _same(FAR)),
    ),
    diagnoses=MISTAKES,
)
