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


def _steps(trajectories):
    return np.hypot(*np.moveaxis(np.diff(trajectories, axis=1)[..., :2], -1, 0))


def _still(inputs, outputs):
    return (_steps(outputs["trajectory"]).sum(axis=1) < 0.5 * short_runs.length(inputs)).any()


def _stops_without_scan(inputs, outputs):
    steps = _steps(outputs["trajectory"])
    return (steps[:, LOST - 1] < 0.5 * np.median(steps, axis=1)).all()


def _as_long_as_odometry(inputs, outputs):
    """Whether the lengths differ as those of odometry, by 10 %, not as those of matches."""
    mine, wheels = (_steps(t).sum(axis=1) for t in (outputs["trajectory"], odometry_poses(inputs)))
    return (np.abs(mine / wheels - 1) < 0.5 * SCALE).all()


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
            asks="Which part of your error lies along the corridor? Does your match change the "
            "distance that odometry states, and do you match with one previous scan or several?",
            step="Compare the length of your trajectory with that of odometry. Then compare the "
            "errors with each scan matched with the previous scan, and with the last five.",
        ),
    ),
    diagnoses=(
        Diagnosis(
            "step-lost",
            "In the reading whose scan is lost, your pose hardly moves. The robot does move, and "
            "odometry measures this step: compose its increment even without a scan.",
            _stops_without_scan,
            asks="How far do your poses move from reading to reading, and how far do they move in "
            "the reading without a scan?",
        ),
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
        Diagnosis(
            "distance-of-odometry",
            "In both runs, the length of your trajectory is that of odometry, which has a scale "
            f"error of {100 * SCALE:.0f} %. The niches show the distance, too: does your match "
            "change x and y, and how small is the standard deviation that it gives odometry?",
            _as_long_as_odometry,
            asks="How long is your trajectory, and how long is that of odometry? Which of the two "
            "measures the distance more accurately, odometry or a match?",
        ),
    ),
    may_round=False,
    begins=(
        "Which pose does odometry give after each reading, and how do you compose its increments?",
        "How far apart are two scans of the same wall if both are drawn at the poses of odometry?",
    ),
)
