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
FIRST = slice(BLIND[0], BLIND[0] + 1)
# the expected value is 3; the errors of neighbouring readings are correlated
LOW, HIGHS = 0.2, np.array([8.0, 12.0, 30.0, 12.0])  # mean NEES in BEFORE, LAST, LATE and FIRST
WIDE = 0.4  # largest σ in the direction of travel in LAST: that of odometry is 0.13 m [m]
TIED = 0.5  # least correlation in LAST of the errors across it and of the heading [1]
OF_ODOMETRY = 0.95


def runs(rng):
    """Return RUNS runs with lost scans, and those of FULL with all scans."""
    chosen = [*range(RUNS), *FULL]
    found = short_runs.corridor(rng, STEPS, bend=1.5, runs=RUNS, bad=0.0)
    inputs = {name: array[chosen] for name, array in found.items()}
    inputs["ranges"][:RUNS, BLIND] = np.nan
    return inputs


def mean_nees(inputs, outputs):
    """Return (4,) the mean NEES in BEFORE, LAST, LATE and FIRST; NaN if a P is invalid."""
    # along the axes of the estimator's own frame, as its covariance: its first pose may be turned
    e = outputs["pose"] - _truth(inputs, outputs)
    e[..., 2] = wrap(e[..., 2])
    try:
        found = nees(e[:, 1:], outputs["covariance"][:, 1:])
    except ValueError:
        return np.full(4, np.nan)
    found = np.insert(found, 0, 0, axis=1)
    parts = found[:RUNS, BEFORE], found[:RUNS, LAST], found[RUNS:, LATE], found[:RUNS, FIRST]
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


def _tied(inputs, outputs):
    """Return the mean correlation in LAST of the error across this direction and the heading's."""
    P = _turned(inputs, outputs, back=True)[:RUNS, LAST]
    return np.mean(P[..., 1, 2] / np.sqrt((P[..., 1, 1] * P[..., 2, 2]).clip(1e-300)))


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
    return all(low <= value <= high for _, value, low, high in _measured(inputs, outputs))


def _measured(inputs, outputs):
    """Return what the notebook's tables limit: (text, value, least, most) of each number."""
    (before, last, late, first), (growth, ratio) = mean_nees(inputs, outputs), _growth(outputs)
    return (
        ("growth of σ of the position without scans", growth, GROWS, np.inf),
        ("σ at its end, relative to that with all scans", ratio, DEPENDS, np.inf),
        ("mean NEES before the scans are lost", before, LOW, HIGHS[0]),
        ("mean NEES in the first reading without a scan", first, LOW, HIGHS[3]),
        ("mean NEES in the last three readings without a scan", last, LOW, HIGHS[1]),
        ("mean NEES in the last seven readings with all scans", late, LOW, HIGHS[2]),
        ("σ in the direction of travel without a scan [m]", _along(inputs, outputs), 0, WIDE),
        ("correlation of the heading and the position across", _tied(inputs, outputs), TIED, 1),
        ("your error before, relative to odometry's", _share(inputs, outputs), 0, OF_ODOMETRY),
    )


def _share(inputs, outputs):
    """Return the mean position error before the scans are lost, relative to odometry's [1]."""
    judged = outputs["pose"], odometry_poses(inputs)
    mine, theirs = (short_runs.offs(inputs, poses)[:RUNS, BEFORE] for poses in judged)
    return mine.mean() / theirs.mean()


def _why(inputs, outputs):
    if np.isnan(mean_nees(inputs, outputs)).any():
        return "A covariance is not positive definite."
    found = [
        f"{text} {value:.3g}{'' if low <= value <= high else ' ✗'}"
        for text, value, low, high in _measured(inputs, outputs)
    ]
    return f"The numbers, ✗ if outside the limits in the text: {'; '.join(found)}."


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
            "σ grows so, and each number of the second table in the text is within its limits",
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
            "Without scans your covariance does not grow enough, or at the end it is not larger "
            "than with all scans. Each increment must increase it, and each match decrease it.",
            lambda i, o: not _grows(i, o),
            asks="What does your code do to the covariance in a reading without a scan, and what "
            "in a reading with a match?",
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
            "Your covariance is overconfident: the errors are far larger than it states. A match "
            "measures the pose relative to earlier scans, whose poses have errors, too; and "
            "matches of neighbouring scans have correlated errors.",
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
            "late",
            "In the first reading without a scan, your covariance is too small. It must belong to "
            "the same reading as pose, and contain the error of this reading's increment.",
            lambda i, o: mean_nees(i, o)[3] >= HIGHS[3],
            asks="To which reading does your covariance belong, and which increments are in it?",
        ),
        Diagnosis(
            "too-modest",
            "In some readings, your covariance is far too large for your errors. Are its numbers "
            "variances, or standard deviations? How much does a match reduce it?",
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
            "not-tied",
            "In the readings without a scan, your covariance states hardly any correlation of the "
            "heading and the position across the direction of travel. An error of the heading "
            "moves the position: compute the covariance with A P Aᵀ.",
            lambda i, o: _tied(i, o) < TIED,
            asks="The heading is off by 0.1 rad to the left. To which side is the position off, "
            "5 m later, and which entries of the covariance state this?",
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
