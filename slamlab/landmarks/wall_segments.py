"""Segments of a wall's line, split at gaps, because a gap may be a door."""

import numpy as np

MAX_GAP = 0.35  # a gap between hits that is wider than this splits the segment [m]


def split_at_gaps(t, gap=MAX_GAP):
    """Split the hits t (n,) at gaps into segments (k, 2) [m]; a single hit makes no segment."""
    t = np.sort(t)
    parts = np.split(t, np.flatnonzero(np.diff(t) > gap) + 1)
    return np.array([[part[0], part[-1]] for part in parts if len(part) > 1]).reshape(-1, 2)


def hull(parts):
    """Return the hull (2,) of sorted segments (k, 2); (∞, −∞) if there are none."""
    return np.array([parts[0, 0], parts[-1, 1]]) if len(parts) else np.array([np.inf, -np.inf])


def union(first, second):
    """Return the union (m, 2) of segments of one line, sorted along the line."""
    rows = np.concatenate([first, second])
    made = []
    for low, high in rows[np.argsort(rows[:, 0])].tolist():
        if made and low <= made[-1][1]:
            made[-1][1] = max(made[-1][1], high)
        else:
            made.append([low, high])
    return np.array(made).reshape(-1, 2)
