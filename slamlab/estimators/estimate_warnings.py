"""Warnings (lists of sentences) about an estimate that may be poor. ``odometry_only`` is a MAK
without landmarks that gets the same odometry; ``scans`` counts the readings with observations."""

import numpy as np

from slamlab.geometry import wrap

MIN_STEPS = 20  # least number of readings, scans or matches for a warning
FEW_POINTS = 60  # with fewer points in a match, scan matching drifts more than odometry
MAX_SIGMA_RATIO = 0.5  # largest ratio of the standard deviation to that of odometry [1]
# largest share of scans with only unknown walls: lines from ultrasound have 0.4, a building 0.26
UNKNOWN = 1 / 3
AMBIGUOUS = 1 / 3  # largest share of ambiguous observations [1]
BEYOND = 6.0  # largest distance from the pose by odometry, in standard deviations [1]
CONFIDENCE = 1.96  # standard deviations of a 95 % confidence interval
ROUNDING = 1e-6  # tolerance of a box against odometry without errors [m]


def weak_matches(weak, matched, unmatched, since=0):
    """Warn if matches are too few or have few points, or if ``since`` steps had no match.
    ``weak`` of the ``matched`` scans have fewer than FEW_POINTS inliers."""
    found = []
    if since >= MIN_STEPS:
        found.append(f"no scan was matched in the last {since} steps: the pose is only predicted")
    if matched + unmatched >= MIN_STEPS:
        if 2 * unmatched > matched + unmatched:
            found.append("most scans were not matched: the trajectory is mostly predicted")
        if 2 * weak > matched:
            found.append(
                f"most matches have fewer than {FEW_POINTS} points, so they are inaccurate"
            )
    return found


def little_better_than_odometry(P, odometry_only, scans):
    """Warn if the position is hardly more certain than an estimate by odometry alone."""
    naive = odometry_only.block([0, 1])
    corrected, naive = (np.sqrt(np.trace(each[:2, :2])) for each in (P, naive))
    if scans < MIN_STEPS or corrected <= MAX_SIGMA_RATIO * naive:
        return []
    return [
        "the position is hardly more certain than by odometry alone: few landmarks are observed "
        "again"
    ]


def contradicts_odometry(pose, odometry_only, scans):
    """Warn if a pose (3,) contradicts odometry, given the covariance of the odometry's pose."""
    off = pose - odometry_only.pose
    off[2] = wrap(off[2])
    # the covariance of odometry without errors is singular
    distance = np.sqrt(off @ np.linalg.pinv(odometry_only.block([0, 1, 2])) @ off)
    if scans < MIN_STEPS or distance <= BEYOND:
        return []
    return [
        f"the pose differs from odometry by {distance:.0f} standard deviations of odometry: one of "
        "the two is wrong"
    ]


def mostly_unknown_walls(unknown, scans):
    """Warn if many scans contain only walls that are not in the map."""
    if scans < MIN_STEPS or unknown <= UNKNOWN * scans:
        return []
    return [
        f"{unknown} of {scans} scans have only unknown walls: many walls of the map may be false"
    ]


def box_too_wide(bor, odometry_only, scans):
    """Warn if the robot's box is no better than one by odometry alone, or wider than the map. A
    uniform density in a box with sides w and h has the standard deviation √((w² + h²)/12)."""
    if scans < MIN_STEPS:
        return []
    found, sides = [], np.diff(bor.robot)[::2]
    naive = np.sqrt(np.trace(odometry_only.block([0, 1])))
    if np.hypot(*sides) / np.sqrt(12) > naive + ROUNDING:
        found.append(
            f"the robot's box is {sides.max():.2f} m wide: the position is no more certain than by "
            "odometry alone"
        )
    boxes = bor.boxes()
    middles = (boxes[:, ::2] + boxes[:, 1::2]) / 2
    if len(middles) > 1 and np.any(sides > np.ptp(middles, axis=0)):
        found.append("the robot's box is wider than the map")
    return found


def uncertainty_wider_than_map(P, landmarks, scans):
    """Warn if the 95 % interval of the position is wider than the map ``landmarks`` (n, 2) [m]."""
    if scans < MIN_STEPS or len(landmarks) < 2:
        return []
    reach = CONFIDENCE * np.sqrt(np.linalg.eigvalsh(P[:2, :2])[-1])
    if 2 * reach <= np.ptp(landmarks, axis=0).max():
        return []
    return [f"the position is known to ±{reach:.2f} m, which is wider than the map"]


def single_landmark(landmarks, scans):
    """Warn if the map has only one landmark, which does not determine the pose."""
    if scans < MIN_STEPS or len(landmarks) != 1:
        return []
    return ["the map has a single landmark, which does not determine a pose without odometry"]


def mostly_ambiguous(ambiguous, observed):
    """Warn if many observations are ambiguous and therefore ignored."""
    if observed < MIN_STEPS or ambiguous <= AMBIGUOUS * observed:
        return []
    return [f"{ambiguous} of {observed} observations are ambiguous and ignored"]
