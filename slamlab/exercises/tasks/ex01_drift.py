"""Exercise 01, the task of foretelling how far a drive drifts."""

import numpy as np

from slamlab.exercises.drives.ex01 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks import ex01_inputs as make
from slamlab.exercises.tasks.ex01_laws import RUNS_TOLERANCE, simulated_drift


def _firsts(i):
    """The first drive of each three: its steps, their length, the error, as columns."""
    return i["n"][::3], i["d"][::3], i["sigma"][::3]


def _near(value, want, share):
    return np.abs(value - want) <= share * want


def _formula(predicted):
    """Diagnosis of a drift that follows a wrong formula of (n, d, σ)."""
    return lambda i, o: _near(o["result"], predicted(i["n"], i["d"], i["sigma"]), 1e-3).all()


DRIFT = Task(
    id="01-drift",
    title="How far off after n steps",
    drive=DRIVES["01-drift"],
    inputs=make.straight_drives,
    shapes={"result": ()},
    laws=(
        Law(
            "simulated",
            2,
            f"4000 simulated drives spread so far sideways (within {RUNS_TOLERANCE:.0%})",
            lambda i, o: _near(
                o["result"][::3],
                np.array(
                    [simulated_drift(int(n), d, s) for n, d, s in zip(*_firsts(i), strict=True)]
                ),
                RUNS_TOLERANCE,
            ),
        ),
        Law(
            "linear",
            1,
            "twice the heading error, twice the drift",
            lambda i, o: (
                _near(o["result"][1::3], 2 * o["result"][::3], 1e-3) & (o["result"][::3] > 0)
            ),
        ),
        Law(
            "longer",
            1,
            "four times as many steps, between eight and nine times the drift",
            lambda i, o: (
                (o["result"][2::3] > 8.1 * o["result"][::3])
                & (o["result"][2::3] < 9.1 * o["result"][::3])
            ),
        ),
    ),
    diagnoses=(
        Diagnosis(
            "each error bends one step",
            "You let each error bend one step only. The robot keeps a wrong heading: an error "
            "bends every step that follows.",
            _formula(lambda n, d, s: s * d * np.sqrt(n)),
        ),
        Diagnosis(
            "errors added up",
            "You add the errors as if all went to the same side. Independent errors partly cancel: "
            "add their squares, then take the root.",
            _formula(lambda n, d, s: s * d * n * (n - 1) / 2),
        ),
        Diagnosis(
            "first step bent too",
            "You bend the first step as well. The robot moves first and picks up the error then: "
            "the first error bends n - 1 steps, the last none.",
            _formula(lambda n, d, s: s * d * np.sqrt(n * (n + 1) * (2 * n + 1) / 6)),
        ),
        Diagnosis(
            "one error at the start",
            "You bend the whole way by a single error. There are n of them, each picked up later.",
            lambda i, o: any(
                _formula(predicted)(i, o)
                for predicted in (
                    lambda n, d, s: s * d * n,
                    lambda n, d, s: s * d * (n - 1),
                )
            ),
        ),
        Diagnosis(
            "whole heading error from the start",
            "You bend the whole way by the heading error of the end. Early steps are bent less: "
            "only by the errors picked up before them.",
            lambda i, o: any(
                _formula(predicted)(i, o)
                for predicted in (
                    lambda n, d, s: s * d * n * np.sqrt(n),
                    lambda n, d, s: s * d * n * np.sqrt(n - 1),
                )
            ),
        ),
        Diagnosis(
            "root forgotten",
            "That is the variance, in m². The spread is its root, in m.",
            _formula(lambda n, d, s: (s * d) ** 2 * n * (n - 1) * (2 * n - 1) / 6),
        ),
        Diagnosis(
            "degrees",
            "The error is given in radians already, and in radians a small angle equals its sine.",
            lambda i, o: any(
                _formula(
                    lambda n, d, s, unit=unit: unit(s) * d * np.sqrt(n * (n - 1) * (2 * n - 1) / 6)
                )(i, o)
                for unit in (np.degrees, np.radians)
            ),
        ),
    ),
)
