"""Whether an estimator works on too little to be believed: its warnings, each a short sentence.

"0 unmatched" says that every scan found a match, not that the match is worth more than odometry.
"""

import numpy as np

MIN_STEPS = 20  # matches or scans before which nothing is said: all begins with little
THIN = 60  # points of a match; on fewer scan matching drifts more than wheels do
SURER = 0.5  # share of odometry's own standard deviation above which a map helps little
# share of scans that show nothing known: a lidar's lines of ultrasound 0.4, in a building 0.26
UNKNOWN = 1 / 3


def thin_matches(thin, matched, unmatched):
    """Warn of scan matching on too few points, or of too few matches.

    Parameters
    ----------
    thin, matched : int, matches on fewer than THIN inliers, and all of them
    unmatched : int, scans that found no match

    Returns
    -------
    list of str
    """
    found = []
    if matched + unmatched >= MIN_STEPS:
        if 2 * unmatched > matched + unmatched:
            found.append("most scans found no match: the way is mostly odometry's")
        if 2 * thin > matched:
            found.append(f"most matches rest on under {THIN} points: odometry may do better")
    return found


def hardly_surer(filter, alone, scans):
    """Warn of a map that corrects nothing, by the filter's own belief and odometry's.

    Parameters
    ----------
    filter : MAK
    alone : MAK without landmarks, predicted by the same odometry
    scans : int, readings with something in them so far

    Returns
    -------
    list of str
    """
    corrected, naive = (np.sqrt(np.trace(each.block([0, 1]))) for each in (filter, alone))
    if scans < MIN_STEPS or corrected <= SURER * naive:
        return []
    return ["its place is hardly surer than by odometry alone: too little is seen again"]


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
