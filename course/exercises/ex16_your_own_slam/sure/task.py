"""Milestone 16-sure: report a consistent covariance."""

import numpy as np

from classroom.exercises.correctness_laws import Diagnosis, Law
from classroom.exercises.task import Task
from course.exercises.ex16_your_own_slam import short_runs
from course.exercises.ex16_your_own_slam.calls import CALLS, integrate_odometry
from slamlab.evaluation.consistency import nees
from slamlab.geometry import compose, wrap

STEPS, RUNS = 33, 12
BLIND = range(10, 30)  # readings whose scans are lost
GROWS = 2.0  # least factor by which σ of the position grows from the first of them to the last [1]
BEFORE, LAST = slice(1, BLIND[0]), slice(BLIND[-1] - 2, BLIND[-1] + 1)
# the expected value is 3; the errors of neighbouring readings are correlated. Over 150 seeds the
# mean NEES of the solution lies between 0.32 and 0.98 before, and between 0.58 and 6.0 at the end.
# The squared error grows several hundredfold, so a constant covariance hardly ever fits both parts
LOW, HIGH = 0.25, 8.0
# a consistent covariance of odometry alone is not sufficient. Over 150 seeds the mean error of
# the solution is at most 0.34 of that of odometry
OF_ODOMETRY = 0.95


def sigmas(outputs):
    """Return (2, n) reported standard deviations of the position [m]."""
    P = outputs["covariance"]
    with np.errstate(invalid="ignore"):
        return np.sqrt(P[..., 0, 0] + P[..., 1, 1])


def mean_nees(inputs, outputs):
    """Return the mean NEES before the scans are lost and in the last three readings without a scan
    (2,); NaN if a P is not a covariance [1]."""
    # along the axes of the estimator's own frame, as its covariance: its first pose may be turned
    route = short_runs.route(inputs)
    e = outputs["pose"] - [compose(poses[0], route) for poses in outputs["pose"]]
    e[..., 2] = wrap(e[..., 2])
    try:
        found = nees(e[:, 1:], outputs["covariance"][:, 1:])
    except ValueError:
        return np.full(2, np.nan)
    return np.array([found[:, part.start - 1 : part.stop - 1].mean() for part in (BEFORE, LAST)])


def _growth(outputs):
    found = sigmas(outputs)
    return (found[:, BLIND[-1]] / np.maximum(found[:, BLIND[0]], 1e-9)).min()


def _grows(inputs, outputs):
    return _growth(outputs) >= GROWS


def is_consistent(inputs, outputs):
    """Return whether the NEES of each part is near 3, and the poses are better than odometry."""
    found = mean_nees(inputs, outputs)
    return ((found > LOW) & (found < HIGH)).all() and _share(inputs, outputs) < OF_ODOMETRY


def _share(inputs, outputs):
    """Return the mean position error before the scans are lost, relative to odometry's [1]."""
    wheels = [integrate_odometry(odometry) for odometry in inputs["odometry"]]
    mine, theirs = (
        short_runs.offs(inputs, poses)[:, BEFORE] for poses in (outputs["pose"], wheels)
    )
    return mine.mean() / theirs.mean()


def _why(inputs, outputs):
    before, last = mean_nees(inputs, outputs)
    if np.isnan(before):
        return "A covariance is not positive definite."
    return (
        f"The mean NEES is {before:.3g} before the scans are lost, and {last:.3g} in the last "
        "three readings without a scan. Its expected value is 3. From the first reading without a "
        "scan to the last, the standard deviation of the position grows by a factor of "
        f"{_growth(outputs):.2f}. Before the scans are lost, the mean position error is "
        f"{_share(inputs, outputs):.2f} times that of odometry."
    )


def _shapes(inputs):
    shape = inputs["odometry"].shape
    return {"pose": shape, "covariance": (*shape, 3)}


SURE = Task(
    id="16-sure",
    title="Report a consistent covariance",
    call=CALLS["16-sure"],
    inputs=lambda rng: short_runs.corridor(rng, STEPS, BLIND, RUNS, bad=0.0),
    shapes=_shapes,
    laws=(
        Law(
            "grows",
            1,
            f"while the scans are lost, σ of the position grows by a factor of at least {GROWS:g}",
            _grows,
            why=_why,
            asks="Without a scan, only odometry measures a step. How does its error change the "
            "covariance of the pose?",
            alone=False,
            step="Print the standard deviation of the position before, during and after the "
            "readings without a scan.",
        ),
        Law(
            "honest",
            2,
            f"the mean NEES lies between {LOW} and {HIGH:g} before the scans are lost, and in the "
            "last three readings without a scan; and before the scans are lost, the mean position "
            f"error is less than {OF_ODOMETRY} times that of odometry",
            is_consistent,
            why=_why,
            asks="How large are your errors? Run your SLAM in practice worlds, and compare the "
            "errors with the covariance that you report.",
            step="Print the NEES of each reading in practice worlds. It should vary around 3, "
            "and not grow with the distance.",
        ),
    ),
    diagnoses=(
        Diagnosis(
            "no-covariance",
            "Your covariance is not valid. From the second reading on, it must be symmetric and "
            "positive definite.",
            lambda i, o: np.isnan(mean_nees(i, o)).any(),
            asks="Which eigenvalues does your covariance have after the second reading? Is it "
            "equal to its transpose?",
        ),
        Diagnosis(
            "constant",
            "Your covariance hardly changes while the scans are lost. The odometry error of each "
            "step must increase it.",
            lambda i, o: _growth(o) < GROWS,
            asks="What does your code do to the covariance in a reading without a scan?",
        ),
        Diagnosis(
            "too-sure",
            "Your covariance is overconfident: the errors are far larger than it states. The "
            "matches of neighbouring scans have correlated errors, so together they contain less "
            "information than independent matches.",
            lambda i, o: mean_nees(i, o).max() >= HIGH,
            asks="How large are your errors, compared with the standard deviations that you "
            "report? How many matches do you count as independent?",
        ),
        Diagnosis(
            "too-modest",
            "Your covariance is far too large for your errors. How much does a match with the "
            "walls reduce the variance?",
            lambda i, o: mean_nees(i, o).min() <= LOW,
            asks="Which line of your code reduces the covariance, and by how much in one reading?",
        ),
    ),
    may_round=False,
    begins=(
        "How does the covariance of a pose change when an odometry increment is composed with it?",
        "Which matrix of a scan match contains how accurate the match is in each direction?",
    ),
)
