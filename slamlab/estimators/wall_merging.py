"""Pieces of one wall: landmarks found apart, through two doors say, that grew together are merged.

The two sides of a wall are no such pieces. Its line's normal points away from where the robot was
when it found it, so they are half a turn apart: two planes, a wall's thickness from each other, and
rightly two landmarks, also where a simulated wall has no thickness.
"""

import numpy as np

from slamlab.filters.merging import merge, squared_difference
from slamlab.geometry import wrap
from slamlab.landmarks.tentative_walls import extent, overlap
from slamlab.landmarks.wall_segments import hull, union

MAX_TURN = np.radians(3)  # between the normals of pieces of one wall [rad]
MERGE_GATE = 9.21  # χ² gate, 2 degrees of freedom: pieces of one wall fail it once in a hundred


def merge_pieces(mak, extents):
    """Merge walls that have turned out to be pieces of one, the surest first.

    Parameters
    ----------
    mak : MAK, of lines; what is merged leaves it
    extents : dict of (k, 2), each wall's id to what was seen of it, from and to [m]; changed, too

    Returns
    -------
    int, how many left
    """
    before = len(extents)
    while pair := pieces_of_one_wall(mak, {i: hull(parts) for i, parts in extents.items()}):
        kept, gone = pair
        ends = ends_of(mak.x[mak.rows([gone])], extents.pop(gone))
        merge(mak, kept, gone)
        line = mak.x[mak.rows([kept])]
        moved = np.array([extent(line, piece) for piece in ends]).reshape(-1, 2)
        extents[kept] = union(extents[kept], moved)
    return before - len(extents)


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
