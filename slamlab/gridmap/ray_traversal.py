"""Ray traversal of a grid (ray tracing): exact, vectorised (after Amanatides and Woo 1987).

Unlike Bresenham's line it misses no cell. A ray enters a new cell where it crosses a grid line. Its
k-th vertical line leads into column i_0 ± k, the row there follows from the height of the crossing;
lines across likewise. So no cell needs the one before it.
"""

import numpy as np


def crossed_cells(start, ends):
    """Cells that rays (beams) cross, without the cells they end in.

    Parameters
    ----------
    start : (2,) where all rays begin [cells]
    ends : (n, 2) where they end [cells]

    Returns
    -------
    (m, 2) int, columns and rows; some more than once
    """
    start, ends = np.asarray(start, dtype=float), np.asarray(ends, dtype=float).reshape(-1, 2)
    first, last = np.floor(start).astype(int), np.floor(ends).astype(int)
    left = (last != first).any()  # whether any ray leaves the first cell
    entered = (_cells_entered(start, ends, first, last, axis) for axis in (0, 1))
    return np.concatenate([np.repeat(first[None], left, axis=0), *entered])


def _cells_entered(start, ends, first, last, axis):
    """Cells that rays enter across the grid lines of one axis, without the last cells."""
    count = np.abs(last - first)[:, axis]
    ray = np.repeat(np.arange(len(ends)), count)
    k = np.arange(len(ray)) - np.repeat(np.cumsum(count) - count, count)  # lines crossed before
    towards = np.sign(last - first)[:, axis][ray]
    # going up a cell is entered by its lower edge, going down by its upper one
    line = first[axis] + towards * k + (towards > 0)
    way = (ends - start)[ray]
    t = (line - start[axis]) / way[:, axis]
    other = 1 - axis
    cells = np.empty((len(ray), 2), dtype=int)
    cells[:, axis] = first[axis] + towards * (k + 1)
    # rounding must not lead out of the rectangle that a ray spans
    low = np.minimum(first[other], last[:, other])[ray]
    high = np.maximum(first[other], last[:, other])[ray]
    height = np.floor(start[other] + t * way[:, other]).astype(int)
    cells[:, other] = np.clip(height, low, high)
    return cells[(cells != last[ray]).any(axis=1)]
