"""Milestone 16-corridor: correct the odometry drift in a corridor."""

import numpy as np

from classroom.exercises.correctness_laws import Diagnosis, Law
from classroom.exercises.task import Task
from course.exercises.ex16_your_own_slam import short_runs
from course.exercises.ex16_your_own_slam.calls import CALLS, odometry_poses

HALF, FAR = 0.5, 0.4  # share of the error of odometry [1]; error [m]
SCALE = 0.05  # scale error of odometry: a correct heading alone is not enough [1]
LOST = 7  # index of the reading whose scan is lost


def ends(inputs, outputs):
    """Return (2,), (2,) errors of the last poses of each run, and those of odometry [m]."""
    judged = outputs["trajectory"], odometry_poses(inputs)
    return [short_runs.off_at_the_end(inputs, t) for t in judged]


def _why(inputs, outputs):
    mine, wheels = ends(inputs, outputs)
    return (
        f"At the end of the two runs, your errors are {mine[0]:.2f} m and {mine[1]:.2f} m. "
        f"Those of odometry are {wheels[0]:.2f} m and {wheels[1]:.2f} m."
    )


def _better(inputs, outputs):
    mine, wheels = ends(inputs, outputs)
    return (mine < HALF * wheels).all()


def _still(inputs, outputs):
    gone = np.hypot(*np.moveaxis(np.diff(outputs["trajectory"], axis=1)[..., :2], -1, 0)).sum(1)
    return (gone < 0.5 * short_runs.length(inputs)).any()


def _worse(inputs, outputs):
    mine, wheels = ends(inputs, outputs)
    return (mine > 1.2 * wheels).any()


BETTER = Law(
    "better",
    1,
    "in both runs, the mean position error of the last five poses is less than half of that of "
    "odometry",
    _better,
    why=_why,
    asks="Which parts of a scan do not move in the world frame while the robot drives?",
    step="Take the first two scans. At which pose of the second scan do most of its "
    "points lie on walls of the first scan?",
)
CORRIDOR = Task(
    id="16-corridor",
    title="Correct the odometry drift in a corridor",
    call=CALLS["16-corridor"],
    inputs=lambda rng: short_runs.corridor(rng, lost=[LOST], scale=SCALE),
    shapes=lambda inputs: {"trajectory": inputs["odometry"].shape},
    laws=(
        BETTER,
        Law(
            "good",
            1,
            f"in both runs, the mean position error of the last five poses is less than {FAR} m",
            lambda inputs, outputs: (ends(inputs, outputs)[0] < FAR).all(),
            why=_why,
            asks="Do you match a scan only with the previous one, or with several previous scans?",
            step="Compare the errors of two versions: each scan matched with the previous "
            "scan, and each scan matched with the last five scans together.",
        ),
    ),
    diagnoses=(
        Diagnosis(
            "stays",
            "Your poses hardly move. Is each odometry increment composed with the previous pose?",
            _still,
            asks="How far is your last pose from your first pose? How far does odometry report "
            "that the robot drove?",
        ),
        Diagnosis(
            "worse",
            "In one run at least, your error is larger than that of odometry. Does a correction "
            "have the wrong sign, is it composed in the wrong order, or does your match begin at "
            "another pose than odometry predicts? Is each increment turned by the heading?",
            _worse,
            asks="At which pose does your match begin, and how far is it from the pose of "
            "odometry? What determines the position along a corridor?",
        ),
    ),
    may_round=False,
    begins=(
        "Which pose does odometry give after each reading, and how do you compose its increments?",
        "How far apart are two scans of the same wall if both are drawn at the poses of odometry?",
    ),
)
