"""Wall segments: a line split at gaps, where a door may be; segments merged (interval union)."""

import numpy as np

MAX_GAP = 0.35  # hits farther apart than this say nothing of what lies between [m]


def split_at_gaps(t, gap=MAX_GAP):
    """Split the hits along a line into segments at gaps (clustering by distance).

    Parameters
    ----------
    t : (n,) where along the line the hits are, in any order [m]
    gap : float, widest within a segment [m]

    Returns
    -------
    (k, 2) from and to [m]; a hit that stands alone makes none
    """
    t = np.sort(t)
    parts = np.split(t, np.flatnonzero(np.diff(t) > gap) + 1)
    return np.array([[part[0], part[-1]] for part in parts if len(part) > 1]).reshape(-1, 2)


def hull(parts):
    """From the first to the last of some segments of a line.

    Parameters
    ----------
    parts : (k, 2) from and to [m], in order

    Returns
    -------
    (2,) from and to [m]; of none (∞, −∞), which nothing overlaps
    """
    return np.array([parts[0, 0], parts[-1, 1]]) if len(parts) else np.array([np.inf, -np.inf])


def union(first, second):
    """Union of the segments of one line: those that overlap are merged.

    Parameters
    ----------
    first, second : (k, 2), (l, 2) from and to [m]

    Returns
    -------
    (m, 2) apart from each other, in order
    """
    rows = np.concatenate([first, second])
    made = []
    for low, high in rows[np.argsort(rows[:, 0])].tolist():
        if made and low <= made[-1][1]:
            made[-1][1] = max(made[-1][1], high)
        else:
            made.append([low, high])
    return np.array(made).reshape(-1, 2)
