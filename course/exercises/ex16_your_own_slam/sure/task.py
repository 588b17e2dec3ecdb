"""Milestone 16-sure: report a consistent covariance."""

import numpy as np

from classroom.exercises.correctness_laws import Diagnosis, Law
from classroom.exercises.task import Task
from course.exercises.ex16_your_own_slam import short_runs
from course.exercises.ex16_your_own_slam.calls import CALLS, odometry_poses
from slamlab.evaluation.consistency import nees
from slamlab.geometry import compose, wrap

STEPS, RUNS = 33, 12
BLIND = range(10, 30)  # readings whose scans are lost in the first RUNS runs
GROWS = 2.0  # least factor by which σ of the position grows from the first of them to the last [1]
FULL = [0, 1, RUNS // 2, RUNS // 2 + 1]  # repeated with all scans: pairs of opposite errors
DEPENDS = 1.5  # least ratio of this last σ to that of the same run with all scans [1]
BEFORE, LAST = slice(1, BLIND[0]), slice(BLIND[-1] - 2, BLIND[-1] + 1)
LATE = slice(BLIND[-1] - 2, STEPS + 1)  # of the runs with all scans
# the expected value is 3; the errors of neighbouring readings are correlated
LOW, HIGHS = 0.2, np.array([8.0, 12.0, 30.0])  # of the mean NEES in BEFORE, LAST and LATE
WIDE = 0.4  # largest σ in the direction of travel in LAST: that of odometry is 0.13 m [m]
OF_ODOMETRY = 0.95


def runs(rng):
    """Return RUNS runs with lost scans, and those of FULL with all scans."""
    chosen = [*range(RUNS), *FULL]
    found = short_runs.corridor(rng, STEPS, bend=1.5, runs=RUNS, bad=0.0)
    inputs = {name: array[chosen] for name, array in found.items()}
    inputs["ranges"][:RUNS, BLIND] = np.nan
    return inputs


def mean_nees(inputs, outputs):
    """Return (3,) the mean NEES in BEFORE, LAST and LATE; NaN if a P is invalid."""
    # along the axes of the estimator's own frame, as its covariance: its first pose may be turned
    e = outputs["pose"] - _truth(inputs, outputs)
    e[..., 2] = wrap(e[..., 2])
    try:
        found = nees(e[:, 1:], outputs["covariance"][:, 1:])
    except ValueError:
        return np.full(3, np.nan)
    found = np.insert(found, 0, 0, axis=1)
    parts = found[:RUNS, BEFORE], found[:RUNS, LAST], found[RUNS:, LATE]
    return np.array([part.mean() for part in parts])


def _truth(inputs, outputs):
    route = short_runs.route(inputs)
    return np.array([compose(poses[0], route) for poses in outputs["pose"]])


def _turned(inputs, outputs, back=False):
    """Return the covariances, turned from the robot frame to that of pose, or back."""
    heading = _truth(inputs, outputs)[..., 2] * (-1 if back else 1)
    c, s, zero = np.cos(heading), np.sin(heading), np.zeros_like(heading)
    R = np.array([[c, -s, zero], [s, c, zero], [zero, zero, zero + 1]]).transpose(2, 3, 0, 1)
    return R @ outputs["covariance"] @ R.swapaxes(-1, -2)


def _along(inputs, outputs):
    """Return the mean σ in the direction of travel in LAST [m]."""
    return np.sqrt(_turned(inputs, outputs, back=True)[:RUNS, LAST, 0, 0].clip(0)).mean()


def _in_robot_frame(inputs, outputs):
    turned = outputs | {"covariance": _turned(inputs, outputs)}
    last, of_turned = (mean_nees(inputs, each)[1] for each in (outputs, turned))
    return of_turned < HIGHS[1] < last and of_turned < last / 3


def _growth(outputs):
    """Return the least factors: from the first reading without a scan to the last, and to the last
    from the same reading of a run with all scans."""
    P = outputs["covariance"]
    with np.errstate(invalid="ignore"):
        found = np.maximum(np.sqrt(P[..., 0, 0] + P[..., 1, 1]), 1e-9)
    last = found[:, BLIND[-1]]
    return (last / found[:, BLIND[0]])[:RUNS].min(), (last[FULL] / last[RUNS:]).min()


def _grows(inputs, outputs):
    return np.all(np.array(_growth(outputs)) >= [GROWS, DEPENDS])


def is_consistent(inputs, outputs):
    """Return whether P fits the errors and grows, and the poses are better than odometry."""
    good = _grows(inputs, outputs) and _share(inputs, outputs) < OF_ODOMETRY
    return good and _fits(inputs, outputs)


def _fits(inputs, outputs):
    found = mean_nees(inputs, outputs)
    return ((found > LOW) & (found < HIGHS)).all() and _along(inputs, outputs) < WIDE


def _share(inputs, outputs):
    """Return the mean position error before the scans are lost, relative to odometry's [1]."""
    judged = outputs["pose"], odometry_poses(inputs)
    mine, theirs = (short_runs.offs(inputs, poses)[:RUNS, BEFORE] for poses in judged)
    return mine.mean() / theirs.mean()


def _why(inputs, outputs):
    (before, last, late), (growth, ratio) = mean_nees(inputs, outputs), _growth(outputs)
    if np.isnan(before):
        return "A covariance is not positive definite."
    return (
        f"The mean NEES is {before:.3g} before the scans are lost, {last:.3g} in the last three "
        f"readings without a scan, and {late:.3g} in the last seven readings of the runs with all "
        "scans. Its expected value is 3. From the first reading without a scan to the last, σ of "
        f"the position grows by a factor of {growth:.2f}; then it is {ratio:.2f} times that of the "
        f"same run with all scans, and {_along(inputs, outputs):.2f} m in the direction of travel. "
        f"Before the scans are lost, your error is {_share(inputs, outputs):.2f} times odometry's."
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
            f"σ grows so; the mean NEES is above {LOW}, and below {HIGHS[0]:g} before the scans "
            f"are lost, {HIGHS[1]:g} in the last three readings without a scan, {HIGHS[2]:g} in "
            f"the last seven with all scans; without a scan, σ in the direction of travel is below "
            f"{WIDE} m; and before, the position error is below {OF_ODOMETRY} times odometry's",
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
            "robot-frame",
            "Without scans, your covariance fits the errors if its axes are those of the robot. "
            "Rotate it into the frame of pose.",
            _in_robot_frame,
            asks="Along which axes is Pxx: those of the robot, or those of the frame of pose?",
        ),
        Diagnosis(
            "too-sure",
            "Your covariance is overconfident: the errors are far larger than it states. Matches "
            "of neighbouring scans have correlated errors: they contain less information than "
            "independent matches.",
            lambda i, o: mean_nees(i, o)[0] >= HIGHS[0],
            asks="How many matches do you count as independent, and how large are your errors?",
        ),
        Diagnosis(
            "odometry-too-sure",
            "Your covariance is too small in a direction in the readings without a scan. An error "
            "of the heading moves the position sideways, by more the farther the robot drives: is "
            "A P Aᵀ in it, with the correct signs in A, and is Q rotated into the frame of pose?",
            lambda i, o: mean_nees(i, o)[1] >= HIGHS[1],
            asks="How far off is the position after 5 m if the heading is off by 0.1 rad?",
        ),
        Diagnosis(
            "too-modest",
            "Your covariance is far too large for your errors. Are its numbers variances, or "
            "standard deviations? How much does a match reduce it?",
            lambda i, o: mean_nees(i, o).min() <= LOW,
            asks="Which numbers of your covariance are squares of a standard deviation?",
        ),
        Diagnosis(
            "too-long",
            "In the readings without a scan, your covariance is far too large in the direction of "
            "travel. Which errors of odometry change the position in this direction?",
            lambda i, o: _along(i, o) >= WIDE,
            asks="How far do the errors of twenty increments move the robot in the direction of "
            "travel, and how far sideways?",
        ),
        Diagnosis(
            "map-too-sure",
            "With all scans, your covariance becomes too small. A match measures the pose relative "
            "to earlier scans, whose poses have errors, too: it does not remove these errors.",
            lambda i, o: mean_nees(i, o)[2] >= HIGHS[2],
            asks="The robot drives 100 m along a corridor and matches each scan with the previous "
            "ones. Does the error of its pose stay as small as that of one match?",
        ),
    ),
    may_round=False,
    begins=(
        "How does the covariance of a pose change when an odometry increment is composed with it?",
        "Which matrix of a scan match contains how accurate the match is in each direction?",
    ),
)
