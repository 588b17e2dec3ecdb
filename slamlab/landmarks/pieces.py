"""Which pieces of a line are wall: where hits stood close together, not where a door may be."""

import numpy as np

HOLE = 0.35  # m, hits farther apart than this say nothing of what lies between


def pieces(t, hole=HOLE):
    """The pieces of a line on which hits stand close together.

    Parameters
    ----------
    t : (n,) where along the line the hits are, in any order [m]
    hole : float [m]

    Returns
    -------
    (k, 2) from and to [m]; a hit that stands alone makes none
    """
    t = np.sort(t)
    parts = np.split(t, np.flatnonzero(np.diff(t) > hole) + 1)
    return np.array([[part[0], part[-1]] for part in parts if len(part) > 1]).reshape(-1, 2)


def union(first, second):
    """Pieces of one line, those that touch put together.

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
