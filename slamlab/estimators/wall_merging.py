"""Landmark merging: line landmarks that are segments of one wall (duplicates) become one.

The two sides of a wall remain two landmarks: their normals are opposite.
"""

import numpy as np

from slamlab.filters.landmark_merging import merge, squared_difference
from slamlab.geometry import wrap
from slamlab.landmarks.track_management import MAX_GAP, extent
from slamlab.landmarks.wall_segments import hull, union

MAX_TURN = np.radians(3)  # largest angle between the normals of segments of one wall [rad]
MERGE_GATE = 9.21  # χ² gate, 2 degrees of freedom: 99 % of the segments of one wall pass


def merge_same_wall_landmarks(mak, extents):
    """Merge landmarks of the same wall, both in a MAK of lines and in ``extents`` {id: (k, 2) start
    and end [m]}, and return the number of merged landmarks."""
    before = len(extents)
    while pair := same_wall_landmarks(mak, {i: hull(parts) for i, parts in extents.items()}):
        kept, gone = pair
        ends = ends_of(mak.x[mak.rows([gone])], extents.pop(gone))
        merge(mak, kept, gone)
        line = mak.x[mak.rows([kept])]
        moved = np.array([extent(line, piece) for piece in ends]).reshape(-1, 2)
        extents[kept] = union(extents[kept], moved)
    return before - len(extents)


def same_wall_landmarks(mak, hulls):
    """Return the ids (kept, gone) of the two closest landmarks inside the gate, or None. ``hulls``
    is {id: (2,) start and end [m]}."""
    lines = dict(zip(mak.ids, mak.landmarks(), strict=True))
    seen = [i for i in lines if np.isfinite(hulls[i]).all()]
    found = [
        (squared_difference(mak, seen[a], seen[b]), (seen[a], seen[b]))
        for a, b in _near(np.array([lines[i] for i in seen]), np.array([hulls[i] for i in seen]))
    ]
    d2, pair = min(found, default=(np.inf, None))
    return pair if d2 < MERGE_GATE else None


def _near(lines, hulls):
    """Return pairs of rows a < b of parallel lines (n, 2) such that an end of b is near a."""
    if len(lines) < 2:
        return []
    rho, alpha = lines.T
    normals, directions = (
        np.column_stack([np.cos(a), np.sin(a)]) for a in (alpha, alpha + np.pi / 2)
    )
    ends = (rho[:, None] * normals)[:, None] + hulls[..., None] * directions[:, None]
    along = np.einsum("ak,bek->abe", directions, ends)
    off = np.abs(np.einsum("ak,bek->abe", normals, ends) - rho[:, None, None]).max(axis=2)
    near = (along.min(axis=2) <= hulls[:, 1:] + MAX_GAP) & (off <= MAX_GAP)
    near &= along.max(axis=2) >= hulls[:, :1] - MAX_GAP
    near &= np.abs(wrap(alpha[:, None] - alpha)) < MAX_TURN
    return np.argwhere(np.triu(near, 1)).tolist()


def ends_of(line, extents):
    """Return the end points (..., 2, 2) [m] of segments (..., 2) on a line (ρ, α)."""
    normal, along = (np.array([np.cos(a), np.sin(a)]) for a in (line[1], line[1] + np.pi / 2))
    return line[0] * normal + np.asarray(extents)[..., None] * along
