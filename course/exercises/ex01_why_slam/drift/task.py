"""Task 01-drift: the lateral error at the end of a straight run."""

import numpy as np

from classroom.exercises.correctness_laws import Diagnosis, equals
from classroom.exercises.task import Probe, Task
from course.exercises.ex01_why_slam.calls import CALLS

COUNT = 21
NEAR = 2e-4
"""Relative tolerance: angles below 0.02 may be replaced by sines (7e-5), wrong formulas are less
accurate."""


def _drives(rng, count=COUNT, least=4, most=49):
    n = rng.permutation(np.linspace(least, most - 1, count).round())
    return {"n": n, "d": rng.uniform(0.2, 0.9, count), "sigma": rng.uniform(0.002, 0.006, count)}


def _with(**numbers):
    def drives(rng):
        count = len(next(iter(numbers.values())))
        return _drives(rng, count) | {name: np.array(of, float) for name, of in numbers.items()}

    return drives


def _want(inputs):
    """P of (lateral position, heading), propagated step by step."""
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
        "steps after the first error": np.maximum(inputs["n"] - 1, 0),
        "sideways motion by one error in one step [m]": inputs["d"] * inputs["sigma"],
    }


def _scattered(inputs, outputs):
    share = outputs["result"] / _want(inputs)["result"] - 1
    return np.abs(share).max() < 0.2 and share.max() > NEAR and share.min() < -NEAR


SIMULATED = Diagnosis(
    "drawn by chance",
    "Your results differ randomly from the correct results, as in a simulation, which is never "
    "exact. Add the variances of the errors instead.",
    _scattered,
    asks="Does your function return the same number for another seed? How large is its error?",
)

DRIFT = Task(
    id="01-drift",
    title="Drift on a straight run",
    call=CALLS["01-drift"],
    inputs=_drives,
    shapes={"result": ()},
    laws=(
        equals(
            "spread",
            3,
            "the standard deviation perpendicular to the line is right for more steps",
            _want,
            tolerance=NEAR,
            asks="How far does the first error alone move the end sideways, and how far does the "
            "last error move it? How do the variances of independent errors add?",
            step=_on_the_way,
        ),
        equals(
            "few",
            1,
            "the standard deviation perpendicular to the line is right for 0, 1, 2 and 3 steps",
            _want,
            tolerance=NEAR,
            asks="Suppose that a run has one step. Does its error occur before or after the robot "
            "moves?",
            step=_on_the_way,
            main=False,
        ),
    ),
    diagnoses=(SIMULATED,),
    begins=(
        "In a run of one step, how far does the error move the end sideways?",
        "In a run of three steps, which steps does the first error turn?",
    ),
    probes=(
        Probe("few steps", _with(n=[0, 1, 2, 3]), ("few",)),
        Probe("many steps", _with(n=[300, 1000]), ("spread",)),
        Probe("no heading errors", _with(sigma=[0, 0, 0]), ("spread",)),
        Probe("steps of 0, 1 and 2 m", _with(d=[0, 1, 1, 2]), ("spread",)),
    ),
)
