"""Milestone 16-sure: report a consistent covariance."""

import numpy as np

from classroom.exercises.correctness_laws import Diagnosis, Law
from classroom.exercises.task import Task
from course.exercises.ex16_your_own_slam import short_runs
from course.exercises.ex16_your_own_slam.calls import CALLS, integrate_odometry
from slamlab.evaluation.consistency import nees
from slamlab.geometry import compose, wrap

STEPS, RUNS = 33, 12
BLIND = range(10, 30)  # readings whose scans are lost in the first RUNS runs
GROWS = 2.0  # least factor by which σ of the position grows from the first of them to the last [1]
DEPENDS = 1.5  # least ratio of this last σ to that of the same run with all scans [1]
BEFORE, LAST = slice(1, BLIND[0]), slice(BLIND[-1] - 2, BLIND[-1] + 1)
# the expected value is 3; the errors of neighbouring readings are correlated. Over 300 seeds the
# mean NEES of the solution lies between 0.32 and 1.0 before, and between 0.58 and 6.0 at the end
LOW, HIGH = 0.25, 8.0
OF_ODOMETRY = 0.95  # over 300 seeds the solution has at most 0.48


def runs(rng):
    """Return RUNS runs with lost scans, and two of them, with opposite errors, with all scans."""
    chosen = [*range(RUNS), 0, RUNS // 2]
    found = short_runs.corridor(rng, STEPS, runs=RUNS, bad=0.0)
    inputs = {name: array[chosen] for name, array in found.items()}
    inputs["ranges"][:RUNS, BLIND] = np.nan
    return inputs


def mean_nees(inputs, outputs):
    """Return (2,) the mean NEES before the scans are lost and in LAST; NaN if a P is invalid."""
    # along the axes of the estimator's own frame, as its covariance: its first pose may be turned
    route = short_runs.route(inputs)
    e = outputs["pose"] - [compose(poses[0], route) for poses in outputs["pose"]]
    e[..., 2] = wrap(e[..., 2])
    try:
        found = nees(e[:, 1:], outputs["covariance"][:, 1:])
    except ValueError:
        return np.full(2, np.nan)
    blind = found[:RUNS]
    return np.array([blind[:, part.start - 1 : part.stop - 1].mean() for part in (BEFORE, LAST)])


def _growth(outputs):
    """Return the least factors: from the first reading without a scan to the last, and to the last
    from the same reading of a run with all scans."""
    P = outputs["covariance"]
    with np.errstate(invalid="ignore"):
        found = np.maximum(np.sqrt(P[..., 0, 0] + P[..., 1, 1]), 1e-9)
    last = found[:, BLIND[-1]]
    return (last / found[:, BLIND[0]])[:RUNS].min(), (last[: RUNS : RUNS // 2] / last[RUNS:]).min()


def _grows(inputs, outputs):
    return np.all(np.array(_growth(outputs)) >= [GROWS, DEPENDS])


def is_consistent(inputs, outputs):
    """Return whether both NEES are near 3, P grows, and the poses are better than odometry."""
    found = mean_nees(inputs, outputs)
    fits = ((found > LOW) & (found < HIGH)).all() and _grows(inputs, outputs)
    return fits and _share(inputs, outputs) < OF_ODOMETRY


def _share(inputs, outputs):
    """Return the mean position error before the scans are lost, relative to odometry's [1]."""
    wheels = [integrate_odometry(odometry) for odometry in inputs["odometry"]]
    mine, theirs = (
        short_runs.offs(inputs, poses)[:RUNS, BEFORE] for poses in (outputs["pose"], wheels)
    )
    return mine.mean() / theirs.mean()


def _why(inputs, outputs):
    (before, last), (growth, ratio) = mean_nees(inputs, outputs), _growth(outputs)
    if np.isnan(before):
        return "A covariance is not positive definite."
    return (
        f"The mean NEES is {before:.3g} before the scans are lost, and {last:.3g} in the last "
        "three readings without a scan. Its expected value is 3. From the first reading without a "
        f"scan to the last, σ of the position grows by a factor of {growth:.2f}; then it is "
        f"{ratio:.2f} times that of the same run with all scans. Before the scans are lost, the "
        f"mean position error is {_share(inputs, outputs):.2f} times that of odometry."
    )


def _shapes(inputs):
    shape = inputs["odometry"].shape
    return {"pose": shape, "covariance": (*shape, 3)}


SURE = Task(
    id="16-sure",
    title="Report a consistent covariance",
    call=CALLS["16-sure"],
    inputs=runs,
    shapes=_shapes,
    laws=(
        Law(
            "grows",
            0.5,
            f"while the scans are lost, σ of the position grows by a factor of at least {GROWS:g}, "
            f"to at least {DEPENDS:g} times that of the same run with all scans",
            _grows,
            why=_why,
            asks="Without a scan, only odometry measures a step. How does its error change the "
            "covariance of the pose?",
            alone=False,
            step="Print σ of the position before, during and after the readings without a scan.",
        ),
        Law(
            "honest",
            1.5,
            f"σ grows so; the mean NEES lies between {LOW} and {HIGH:g} before the scans are lost, "
            "and in the last three readings without a scan; and before the scans are lost, the "
            f"mean position error is less than {OF_ODOMETRY} times that of odometry",
            is_consistent,
            why=_why,
            asks="Run your SLAM in practice worlds. How large are its errors, compared with P?",
            step="Print the NEES of each reading in practice worlds. It should vary around 3, "
            "and not grow with the distance.",
        ),
    ),
    diagnoses=(
        Diagnosis(
            "no-covariance",
            "From the second reading on, your covariance must be symmetric and positive definite.",
            lambda i, o: np.isnan(mean_nees(i, o)).any(),
            asks="Which eigenvalues has your covariance? Is it equal to its transpose?",
        ),
        Diagnosis(
            "constant",
            "Your covariance hardly depends on the scans. Without them, odometry must increase it.",
            lambda i, o: not _grows(i, o),
            asks="What does your code do to the covariance in a reading without a scan?",
        ),
        Diagnosis(
            "too-sure",
            "Your covariance is overconfident: the errors are far larger than it states. Matches "
            "of neighbouring scans have correlated errors: they contain less information than "
            "independent matches.",
            lambda i, o: mean_nees(i, o)[0] >= HIGH,
            asks="How many matches do you count as independent, and how large are your errors?",
        ),
        Diagnosis(
            "odometry-too-sure",
            "Your covariance is too small in the readings without a scan. An error of the heading "
            "moves the position sideways, by more the farther the robot drives: is A P Aᵀ in it?",
            lambda i, o: mean_nees(i, o)[1] >= HIGH,
            asks="How far off is the position after 5 m if the heading is off by 0.1 rad?",
        ),
        Diagnosis(
            "too-modest",
            "Your covariance is far too large for your errors. How much does a match reduce it?",
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
