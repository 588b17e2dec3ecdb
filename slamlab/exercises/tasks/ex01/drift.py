"""Task 01-drift: how far a straight drive ends from its line."""

import numpy as np

from slamlab.exercises.drives.ex01 import DRIVES
from slamlab.exercises.law import Diagnosis, equals
from slamlab.exercises.task import Probe, Task

COUNT = 21
NEAR = 2e-4
"""Share that an answer may be off: sines stand for angles below 0.02 (7e-5), no wrong form does."""


def _drives(rng, count=COUNT, least=4, most=49):
    """Straight drives: how many steps, of which length, and the error after each."""
    n = rng.permutation(np.linspace(least, most - 1, count).round())
    return {"n": n, "d": rng.uniform(0.2, 0.9, count), "sigma": rng.uniform(0.002, 0.006, count)}


def _with(**numbers):
    """Drives of which some numbers are given."""

    def drives(rng):
        count = len(next(iter(numbers.values())))
        return _drives(rng, count) | {name: np.array(of, float) for name, of in numbers.items()}

    return drives


def _want(inputs):
    """Sideways place and heading err together; P grows from step to step."""
    found = []
    for n, d, sigma in zip(*inputs.values(), strict=True):
        F, P = np.array([[1.0, d], [0.0, 1.0]]), np.zeros((2, 2))
        for _ in range(int(n)):
            P = F @ P @ F.T
            P[1, 1] += sigma**2
        found.append(np.sqrt(P[0, 0]))
    return {"result": np.array(found)}


def _on_the_way(inputs):
    return {
        "the first error bends so many steps": np.maximum(inputs["n"] - 1, 0),
        "one error that bends one step leads aside by [m]": inputs["d"] * inputs["sigma"],
    }


def _scattered(inputs, outputs):
    """Whether all are nearly right, and some too large, some too small."""
    share = outputs["result"] / _want(inputs)["result"] - 1
    return np.abs(share).max() < 0.2 and share.max() > NEAR and share.min() < -NEAR


SIMULATED = Diagnosis(
    "drawn by chance",
    "Your numbers scatter about the right ones, as those of a simulation do, which is never "
    "exact. Add up the variances of the errors instead.",
    _scattered,
)

DRIFT = Task(
    id="01-drift",
    title="How far off after n steps",
    drive=DRIVES["01-drift"],
    inputs=_drives,
    shapes={"result": ()},
    laws=(
        equals(
            "few",
            1,
            "a drive of no step, of one, two or three ends as far sideways as it should",
            _want,
            tolerance=NEAR,
            asks="A drive of one step: which of its errors was there before the robot moved?",
            step=_on_the_way,
            main=False,
        ),
        equals(
            "spread",
            3,
            "so does a drive of more steps: one standard deviation",
            _want,
            tolerance=NEAR,
            asks="How far sideways does the first error alone lead, and how far the last? How do "
            "independent errors add up?",
            step=_on_the_way,
        ),
    ),
    diagnoses=(SIMULATED,),
    probes=(
        Probe("few steps", _with(n=[0, 1, 2, 3]), ("few",)),
        Probe("many steps", _with(n=[300, 1000]), ("spread",)),
        Probe("wheels that never err", _with(sigma=[0, 0, 0]), ("spread",)),
        Probe("steps of a whole metre, or none", _with(d=[0, 1, 1, 2]), ("spread",)),
    ),
)
