"""Pieces of one wall: landmarks found apart, through two doors say, that grew together are merged.

The two sides of a wall are no such pieces. Its line's normal points away from where the robot was
when it found it, so they are half a turn apart: two planes, a wall's thickness from each other, and
rightly two landmarks, also where a simulated wall has no thickness.
"""

import numpy as np

from slamlab.filters.merging import squared_difference
from slamlab.geometry import wrap
from slamlab.landmarks.tentative_walls import extent, overlap

MAX_TURN = np.radians(3)  # between the normals of pieces of one wall [rad]
MERGE_GATE = 9.21  # χ² gate, 2 degrees of freedom: pieces of one wall fail it once in a hundred


def pieces_of_one_wall(mak, hulls):
    """The two landmarks that are most surely one wall: parallel, near, and one by the filter.

    Parameters
    ----------
    mak : MAK, of lines
    hulls : dict of (2,), each wall's id to where along its line it begins and ends [m]

    Returns
    -------
    (kept, gone) ids, the older one first; None where no two are one wall
    """
    ids, lines = mak.ids, mak.landmarks()
    turn = np.abs(wrap(lines[:, None, 1] - lines[:, 1]))
    pairs = [(ids[a], ids[b]) for a, b in np.argwhere(np.triu(turn < MAX_TURN, 1))]
    walls = dict(zip(ids, lines, strict=True))
    near = [
        (squared_difference(mak, i, j), (i, j))
        for i, j in pairs
        if overlap(hulls[i], extent(walls[i], ends_of(walls[j], hulls[j])))
    ]
    d2, pair = min(near, default=(np.inf, None))
    return pair if d2 < MERGE_GATE else None


def ends_of(line, extents):
    """Points on a line where pieces of it begin and end.

    Parameters
    ----------
    line : (2,) ρ [m], α [rad]
    extents : (..., 2) from and to along the line [m]

    Returns
    -------
    (..., 2, 2) points [m]
    """
    normal, way = (np.array([np.cos(a), np.sin(a)]) for a in (line[1], line[1] + np.pi / 2))
    return line[0] * normal + np.asarray(extents)[..., None] * way
