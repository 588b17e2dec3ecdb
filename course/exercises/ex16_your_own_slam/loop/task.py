"""Milestone 16-loop: close a loop, and correct the poses before the loop closure."""

import numpy as np

from classroom.exercises.correctness_laws import Diagnosis, Law
from classroom.exercises.task import Task
from course.exercises.ex16_your_own_slam import short_runs
from course.exercises.ex16_your_own_slam.calls import CALLS, odometry_poses

MET, CARRIED = 0.1, 0.16  # [m]


def met(inputs, outputs):
    """Return (2,) position errors after the loop, relative to the first pose [m]."""
    return short_runs.off_at_the_end(inputs, outputs["trajectory"])


def carried(inputs, outputs):
    """Return (2,) root mean square position errors of all poses [m]."""
    return np.sqrt(np.square(short_runs.offs(inputs, outputs["trajectory"])).mean(axis=1))


def _why(inputs, outputs):
    ends, all_poses = met(inputs, outputs), carried(inputs, outputs)
    return (
        f"Back at the start, the position errors of the two runs are {ends[0]:.2f} m and "
        f"{ends[1]:.2f} m. The root mean square errors of all poses are {all_poses[0]:.2f} m "
        f"and {all_poses[1]:.2f} m."
    )


LOOP = Task(
    id="16-loop",
    title="Close a loop",
    call=CALLS["16-loop"],
    inputs=short_runs.ring,
    shapes=lambda inputs: {"trajectory": inputs["odometry"].shape},
    laws=(
        Law(
            "met",
            1.5,
            f"back at the start, the mean position error of the last five poses is less than "
            f"{MET} m",
            lambda inputs, outputs: (met(inputs, outputs) < MET).all(),
            why=_why,
            asks="How can your SLAM detect that it observes the walls of the first scans again?",
            step="Print, for each reading, the old poses that are nearer than two metres and "
            "older than twenty readings. For which readings is there one?",
        ),
        Law(
            "carried",
            1.5,
            f"the root mean square position error of all poses is less than {CARRIED} m",
            lambda inputs, outputs: (carried(inputs, outputs) < CARRIED).all(),
            why=_why,
            asks="After the loop closure, which of the earlier poses must change, and by how much?",
            step="Print the correction of each pose by the loop closure. It must be zero at "
            "the first pose, and largest at the last one.",
        ),
    ),
    diagnoses=(
        Diagnosis(
            "last-only",
            "Your last poses are right, but the earlier ones are not. Does trajectory() give the "
            "current estimates of all poses? Does the loop closure correct all of them, and most "
            "where most of the error arose, in the readings without a scan?",
            lambda i, o: (met(i, o) < MET).all() and (carried(i, o) >= CARRIED).any(),
            asks="Which poses does your loop closure change, and which poses does trajectory() "
            "return?",
        ),
        Diagnosis(
            "far-off",
            "Your SLAM is far worse than odometry. Does it use the odometry of each reading, also "
            "without a scan? If it closes a loop: does the constraint state the pose of the later "
            "scan in the frame of the earlier one, and was the match right?",
            lambda i, o: (met(i, o) > 2 * met(i, {"trajectory": odometry_poses(i)})).any(),
            asks="How large is the residual of each constraint before and after the optimisation? "
            "What does your code do with a reading without a scan?",
        ),
        Diagnosis(
            "not-closed",
            "The last scans do not fit the first ones: the loop was not closed, or not correctly. "
            "Find an old pose near the current one, match with the scans near this old pose, and "
            "constrain the relative pose of the two by the result.",
            lambda i, o: (met(i, o) >= MET).any(),
            asks="Which constraint of your SLAM relates the last scan to the first one?",
        ),
    ),
    may_round=False,
    begins=(
        "At which reading does the robot see the walls of the first scan again?",
        "How far is the last pose from the first pose in the estimate of milestone 1?",
    ),
)
