"""Whether an estimator works on too little to be believed: its warnings, each a short sentence.

"0 unmatched" says that every scan found a match, not that the match is worth more than odometry.
"""

import numpy as np

from slamlab.geometry import wrap

MIN_STEPS = 20  # readings, scans or matches before which nothing is said: all begins with little
THIN = 60  # points of a match; on fewer scan matching drifts more than wheels do
SURER = 0.5  # share of odometry's own standard deviation above which a map helps little
# share of scans that show nothing known: a lidar's lines of ultrasound 0.4, in a building 0.26
UNKNOWN = 1 / 3
AMBIGUOUS = 1 / 3  # share of observations that are ambiguous above which a map is a muddle
BEYOND = 6.0  # Mahalanobis distance from odometry's pose that its own covariance rules out [1]
CONFIDENCE = 1.96  # standard deviations to either side that hold 95 %
ROUNDING = 1e-6  # m, by which a box may be wider than odometry that makes no error


def thin_matches(thin, matched, unmatched, since=0):
    """Warn of scan matching on too few points, of too few matches, or of none any more.

    Parameters
    ----------
    thin, matched : int, matches on fewer than THIN inliers, and all of them
    unmatched : int, scans that found no match
    since : int, steps of the robot since the last match

    Returns
    -------
    list of str
    """
    found = []
    if since >= MIN_STEPS:
        found.append(f"no scan was matched in the last {since} steps: since then it is odometry")
    if matched + unmatched >= MIN_STEPS:
        if 2 * unmatched > matched + unmatched:
            found.append("most scans found no match: the way is mostly odometry's")
        if 2 * thin > matched:
            found.append(f"most matches rest on under {THIN} points: odometry may do better")
    return found


def hardly_surer(P, alone, scans):
    """Warn of a map that corrects nothing, by the filter's own belief and odometry's.

    Parameters
    ----------
    P : (3, 3) or (2, 2) covariance of the pose or place, as the filter believes it [m², rad²]
    alone : MAK without landmarks, predicted by the same odometry
    scans : int, readings with something in them so far

    Returns
    -------
    list of str
    """
    corrected, naive = (np.sqrt(np.trace(each[:2, :2])) for each in (P, alone.block([0, 1])))
    if scans < MIN_STEPS or corrected <= SURER * naive:
        return []
    return ["its place is hardly surer than by odometry alone: too little is seen again"]


def against_odometry(pose, alone, scans):
    """Warn of a pose that odometry rules out: farther from its own than its covariance allows.

    Parameters
    ----------
    pose : (3,) as estimated [m, m, rad]
    alone : MAK without landmarks, predicted by the same odometry
    scans : int, readings with something in them so far

    Returns
    -------
    list of str
    """
    off = pose - alone.pose
    off[2] = wrap(off[2])
    # odometry that makes no error has a covariance without an inverse
    distance = np.sqrt(off @ np.linalg.pinv(alone.block([0, 1, 2])) @ off)
    if scans < MIN_STEPS or distance <= BEYOND:
        return []
    return [
        f"its pose is {distance:.0f} times as far from odometry's as odometry errs: one of the two "
        "is wrong"
    ]


def mostly_unknown(unknown, scans):
    """Warn of scans that show nothing known.

    Parameters
    ----------
    unknown, scans : int, scans that showed only what was new, and all of them

    Returns
    -------
    list of str
    """
    if scans < MIN_STEPS or unknown <= UNKNOWN * scans:
        return []
    return [f"{unknown} of {scans} scans show only unknown walls: the map may be of chance finds"]


def box_too_wide(bor, alone, scans):
    """Warn of a box so wide that it says no more than odometry, or nothing within its map.

    A place that is drawn anywhere in a box of the sides w and h deviates by √((w² + h²)/12).

    Parameters
    ----------
    bor : BOR
    alone : MAK without landmarks, predicted by the same odometry
    scans : int, readings with something in them so far

    Returns
    -------
    list of str
    """
    if scans < MIN_STEPS:
        return []
    found, sides = [], np.diff(bor.robot)[::2]
    naive = np.sqrt(np.trace(alone.block([0, 1])))
    if np.hypot(*sides) / np.sqrt(12) > naive + ROUNDING:
        found.append(
            f"its box is {sides.max():.2f} m wide: by it the place is no surer than by odometry "
            "alone"
        )
    boxes = bor.boxes()
    middles = (boxes[:, ::2] + boxes[:, 1::2]) / 2
    if len(middles) > 1 and np.any(sides > np.ptp(middles, axis=0)):
        found.append("its box is wider than all that it has mapped")
    return found


def wider_than_map(P, places, scans):
    """Warn of a place so uncertain that 95 % of the belief is longer than all that was mapped.

    Parameters
    ----------
    P : (2, 2) covariance of the place, as the filter believes it [m²]
    places : (n, 2) landmarks, or ends of walls [m]
    scans : int, readings with something in them so far

    Returns
    -------
    list of str
    """
    if scans < MIN_STEPS or len(places) < 2:
        return []
    reach = CONFIDENCE * np.sqrt(np.linalg.eigvalsh(P[:2, :2])[-1])
    if 2 * reach <= np.ptp(places, axis=0).max():
        return []
    return [f"its place is known to ±{reach:.2f} m: that is wider than all that it has mapped"]


def single_landmark(places, scans):
    """Warn of a map of one landmark, round which the robot may stand anywhere.

    Its distance and bearing are two numbers, and a pose has three.

    Parameters
    ----------
    places : (n, 2) landmarks [m]
    scans : int, readings with something in them so far

    Returns
    -------
    list of str
    """
    if scans < MIN_STEPS or len(places) != 1:
        return []
    return ["its map is a single landmark: that does not fix a pose, odometry has to do the rest"]


def mostly_ambiguous(ambiguous, observed):
    """Warn of observations that were ignored because they may be of several landmarks.

    Parameters
    ----------
    ambiguous, observed : int, those ignored, and all of them

    Returns
    -------
    list of str
    """
    if observed < MIN_STEPS or ambiguous <= AMBIGUOUS * observed:
        return []
    return [f"{ambiguous} of {observed} observations are ambiguous and ignored"]
