"""Milestone 16-sure: an own SLAM that says how sure it is of its pose, and says it truly."""

import numpy as np

from slamlab.evaluation.consistency import nees
from slamlab.exercises.drives.ex16 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex16 import short_drives
from slamlab.geometry import between, wrap

BLIND = range(8, 14)  # readings whose scans are lost
GROWS = 1.3  # by which factor σ of the place grows meanwhile, at least [1]
# 3 is right on average; the readings of a drive hang together, and few drives are tried.
# Over 200 seeds the solution's mean lies between 0.19 and 6.6
LOW, HIGH = 0.05, 20.0


def sigmas(outputs):
    """(2, n) standard deviation of the place, as claimed [m]."""
    P = outputs["covariance"]
    with np.errstate(invalid="ignore"):
        return np.sqrt(P[..., 0, 0] + P[..., 1, 1])


def mean_nees(inputs, outputs):
    """Mean NEES over both drives but for their first readings; NaN where a P is none [1]."""
    e = np.array([between(poses[0], poses) for poses in outputs["pose"]])
    e = e - short_drives.route(inputs)
    e[..., 2] = wrap(e[..., 2])
    try:
        return float(nees(e[:, 1:], outputs["covariance"][:, 1:]).mean())
    except ValueError:
        return np.nan


def _growth(outputs):
    found = sigmas(outputs)
    return (found[:, BLIND[-1]] / np.maximum(found[:, BLIND[0] - 1], 1e-9)).min()


def _grows(inputs, outputs):
    return _growth(outputs) >= GROWS


def _honest(inputs, outputs):
    return LOW < mean_nees(inputs, outputs) < HIGH


def _why(inputs, outputs):
    found = mean_nees(inputs, outputs)
    if np.isnan(found):
        return "A covariance is not positive definite."
    return (
        f"The mean NEES is {found:.3g}, where 3 is right; while nothing is seen, σ of the place "
        f"grows by a factor of {_growth(outputs):.2f}."
    )


def _shapes(inputs):
    shape = inputs["odometry"].shape
    return {"pose": shape, "covariance": (*shape, 3)}


SURE = Task(
    id="16-sure",
    title="It says how sure it is",
    drive=DRIVES["16-sure"],
    inputs=lambda rng: short_drives.corridor(rng, lost=BLIND),
    shapes=_shapes,
    needs=("16-corridor",),  # true of the wheels alone is not what is asked
    laws=(
        Law(
            "grows",
            1,
            f"while nothing is seen, σ of the place grows, by a factor of {GROWS} at least",
            _grows,
            why=_why,
            asks="What do you know of a step that only the wheels have measured?",
            alone=False,
        ),
        Law(
            "honest",
            2,
            f"the mean NEES of the poses given on the way lies between {LOW} and {HIGH:g}",
            _honest,
            why=_why,
            asks="How large are your errors? Drive through practice worlds, and compare them with "
            "what you claim.",
        ),
    ),
    diagnoses=(
        Diagnosis(
            "no-covariance",
            "A covariance is symmetric and positive definite, from the second reading on.",
            lambda i, o: np.isnan(mean_nees(i, o)),
        ),
        Diagnosis(
            "too-sure",
            "The errors are far larger than the covariance allows. Matched scans share their "
            "errors with their neighbours: what they say together is less than it seems.",
            lambda i, o: mean_nees(i, o) >= HIGH,
        ),
        Diagnosis(
            "too-modest",
            "The errors are far smaller than the covariance says: a robot that sees walls knows "
            "more.",
            lambda i, o: mean_nees(i, o) <= LOW,
        ),
        Diagnosis(
            "constant",
            "The covariance hardly changes while nothing is seen: let it grow with each step.",
            lambda i, o: _growth(o) < GROWS,
        ),
    ),
    rounds=False,
)
