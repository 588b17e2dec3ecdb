"""The task of exercise 13 about several scans: no motion may be lost on the way."""

import numpy as np

from slamlab.exercises.drives.ex13 import DRIVES, ROUNDS
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex13_clouds import (
    carried,
    either_sign,
    good_guess,
    landed,
    motion,
    outline,
)
from slamlab.exercises.tasks.ex13_icp import stacked
from slamlab.geometry import matrix
from slamlab.scanmatching import point_to_point

COURSES, SCANS, SEEN = 2, 4, 36


def courses(rng):
    """Robots that turn and drive through a room, scan it four times and misjudge every step."""
    return stacked(one_course(rng) for _ in range(COURSES))


def one_course(rng):
    """(4, n, 2) scans, each in the robot's frame, and (3, 3, 3) steps as odometry tells them."""
    room = outline(rng, SEEN)
    scans, steps = [room], []
    for _ in range(SCANS - 1):
        T = motion(*either_sign(rng, 0.2, 0.5, 2), either_sign(rng, 0.6, 1.3))
        scan = rng.permutation(carried(np.linalg.inv(T), scans[-1]))
        steps.append(good_guess(rng, T, scan, scans[-1]))
        scans.append(scan)
    return {"scans": np.array(scans), "steps": np.array(steps)}


def lies(T, scan, over):
    """(...) whether a motion lands every point of a scan on a point of another."""
    return landed(T, scan, over) == scan.shape[-2]


def complete(outputs):
    """Whether there is a pose for every scan."""
    return outputs["poses"].shape[1] == SCANS


def _start(inputs, outputs):
    return np.abs(outputs["poses"][:, 0] - np.eye(3)).max(axis=(1, 2)) < 1e-9


def _lands(inputs, outputs):
    if not complete(outputs):
        return False
    first = np.broadcast_to(inputs["scans"][:, :1], inputs["scans"].shape)
    return lies(outputs["poses"], inputs["scans"], first)[:, 1:]


# ---- mistakes -------------------------------------------------------------------------------


def steps_between(outputs):
    """(c, 3, 3, 3) the motion from each pose to the next, seen from the former."""
    poses = outputs["poses"]
    return np.linalg.inv(poses[:, :-1]) @ poses[:, 1:]


def first_pose_missing(inputs, outputs):
    return outputs["poses"].shape[1] == SCANS - 1


def first_motion_lost(inputs, outputs):
    """As the listing of the thesis: the second scan is only remembered, not placed."""
    if not complete(outputs):
        return False
    still = np.allclose(outputs["poses"][:, 1], np.eye(3))
    scans = inputs["scans"]
    return still and lies(steps_between(outputs)[:, 1:], scans[:, 2:], scans[:, 1:-1]).all()


def not_accumulated(inputs, outputs):
    scans = inputs["scans"]
    return complete(outputs) and lies(outputs["poses"][:, 1:], scans[:, 1:], scans[:, :-1]).all()


def wrong_side(inputs, outputs):
    if not complete(outputs):
        return False
    poses, scans = outputs["poses"], inputs["scans"]
    steps = poses[:, 1:] @ np.linalg.inv(poses[:, :-1])
    return lies(steps, scans[:, 1:], scans[:, :-1]).all()


def odometry_only(inputs, outputs):
    return complete(outputs) and np.allclose(steps_between(outputs), inputs["steps"], atol=1e-6)


def inverted(inputs, outputs):
    return _lands(inputs, {"poses": np.linalg.inv(outputs["poses"])}).all()


def steps_ignored(inputs, outputs):
    """ICP started from rest instead of from odometry's step."""
    ends = [
        point_to_point(scans[1], scans[0], tolerance=1e-12, max_rounds=ROUNDS).pose
        for scans in inputs["scans"]
    ]
    return all(
        np.allclose(matrix(end), T, atol=1e-6)
        for end, T in zip(ends, outputs["poses"][:, 1], strict=True)
    )


WALK = Task(
    id="13-walk",
    title="A walk of several scans",
    drive=DRIVES["13-walk"],
    inputs=courses,
    shapes={"poses": (COURSES, None, 3, 3)},
    laws=(
        Law("start", 1, "the first scan's frame is the map's: its pose is the identity", _start),
        Law("lands", 2, "each pose lays its scan over the first one", _lands),
    ),
    diagnoses=(
        Diagnosis(
            "first-pose-missing",
            "There is one pose too few: a walk of n scans has n poses, the first is the identity.",
            first_pose_missing,
        ),
        Diagnosis(
            "first-motion-lost",
            "The second scan's motion is lost: its pose is still the identity, so all that follows "
            "is displaced. The first scan is the map and what the second is matched with.",
            first_motion_lost,
        ),
        Diagnosis(
            "not-accumulated",
            "Each pose is seen from the scan before, not from the first one. Put every match "
            "on the right of the pose so far: pose @ T.",
            not_accumulated,
        ),
        Diagnosis(
            "wrong-side",
            "A match tells the motion in the frame of the scan before, so it goes to the right of "
            "the pose so far: pose @ T, not T @ pose.",
            wrong_side,
        ),
        Diagnosis(
            "odometry-only",
            "These are odometry's steps put together. They are only the first guess of each match.",
            odometry_only,
        ),
        Diagnosis(
            "inverted",
            "These are the inverse motions: a pose carries its scan into the first one's frame.",
            inverted,
        ),
        Diagnosis(
            "steps-ignored",
            "The matches start from rest. Give ICP odometry's step as the first guess: without it "
            "the nearest points are the wrong ones.",
            steps_ignored,
        ),
    ),
    needs=("13-icp",),
)
