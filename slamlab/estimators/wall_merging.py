"""Pieces of one wall: landmarks found apart, through two doors say, that grew together are merged.

The two sides of a wall are no such pieces. Its line's normal points away from where the robot was
when it found it, so they are half a turn apart: two planes, a wall's thickness from each other, and
rightly two landmarks, also where a simulated wall has no thickness.
"""

import numpy as np

from slamlab.filters.merging import merge, squared_difference
from slamlab.geometry import wrap
from slamlab.landmarks.tentative_walls import MAX_GAP, extent
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

    Near are those of which none begins farther than half a metre from the other, along or across.

    Parameters
    ----------
    mak : MAK, of lines
    hulls : dict of (2,), each wall's id to where along its line it begins and ends [m]

    Returns
    -------
    (kept, gone) ids, the older one first; None where no two are one wall
    """
    lines = dict(zip(mak.ids, mak.landmarks(), strict=True))
    seen = [i for i in lines if np.isfinite(hulls[i]).all()]
    found = [
        (squared_difference(mak, seen[a], seen[b]), (seen[a], seen[b]))
        for a, b in _near(np.array([lines[i] for i in seen]), np.array([hulls[i] for i in seen]))
    ]
    d2, pair = min(found, default=(np.inf, None))
    return pair if d2 < MERGE_GATE else None


def _near(lines, hulls):
    """Rows a < b of (n, 2) lines that are parallel, and of which b begins or ends near a."""
    if len(lines) < 2:
        return []
    rho, alpha = lines.T
    normals, ways = (np.column_stack([np.cos(a), np.sin(a)]) for a in (alpha, alpha + np.pi / 2))
    ends = (rho[:, None] * normals)[:, None] + hulls[..., None] * ways[:, None]
    along = np.einsum("ak,bek->abe", ways, ends)
    off = np.abs(np.einsum("ak,bek->abe", normals, ends) - rho[:, None, None]).max(axis=2)
    near = (along.min(axis=2) <= hulls[:, 1:] + MAX_GAP) & (off <= MAX_GAP)
    near &= along.max(axis=2) >= hulls[:, :1] - MAX_GAP
    near &= np.abs(wrap(alpha[:, None] - alpha)) < MAX_TURN
    return np.argwhere(np.triu(near, 1)).tolist()


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
