"""Correlative search (correlative scan matching): all turns and translations, on a coarse grid.

For each turn the source is rasterised into a grid of cells and correlated with the target's; the
FFT gives all translations in one go. It has no local minima, and a cell's resolution.
"""

import numpy as np
from scipy import fft

CELLS = 64  # on the grid's side: a power of two suits the FFT
EXTENT_QUANTILE = 0.95  # quantile of the ranges that the grid shall hold [1]
MIN_PEAK_SHARE = 0.6  # of the best correlation: less is no candidate [1]
MAX_PEAK_CELLS = 2000  # cells of the correlation examined for peaks
TURNS_AT_ONCE = 16  # correlated together: their grids stay in the cache
MIN_SEPARATION = 2  # cells, and steps of turn: least separation of two peaks


def candidate_poses(source, target, initial, turn=np.pi, count=6):
    """Candidate poses by correlative search: where most cells of source and target coincide.

    Parameters
    ----------
    source, target : Surface
    initial : (3,) initial guess [m, m, rad]
    turn : float, how far from the initial guess to turn [rad]
    count : int, poses at most

    Returns
    -------
    (k, 3) poses, the best first [m, m, rad]
    """
    extent = max(*(np.quantile(s.ranges, EXTENT_QUANTILE) for s in (source, target)), 1e-9)
    size = 4 * extent / CELLS  # twice the extent for the surface, as much for its way
    # the farthest points then go from cell to cell
    steps = int(np.ceil(min(turn, np.pi) * extent / size / 1.0))
    turns = initial[2] + np.arange(-steps, steps + 1) * (min(turn, np.pi) / max(steps, 1))
    if turn >= np.pi:
        turns = turns[:-1]
    score = cross_correlation(source, target, turns, size)
    return _peaks(score, turns, size, count)


def cross_correlation(source, target, turns, size):
    """Cross-correlation of source and target by FFT: (k, CELLS, CELLS), how many cells coincide,
    by turn and by shift along y and x, both from zero up and from minus one down."""
    walls = _rasterised(target.x[None], target.y[None], size)
    near = sum(np.roll(walls, shift, axis) for axis in (1, 2) for shift in (-1, 1))
    walls = fft.rfft2(np.maximum(walls, 0.5 * np.minimum(near, 1)))
    score = np.empty((len(turns), CELLS, CELLS), dtype=np.float32)
    for first in range(0, len(turns), TURNS_AT_ONCE):
        some = slice(first, first + TURNS_AT_ONCE)
        c, s = np.cos(turns[some])[:, None], np.sin(turns[some])[:, None]
        seen = _rasterised(c * source.x - s * source.y, s * source.x + c * source.y, size)
        score[some] = fft.irfft2(walls * np.conj(fft.rfft2(seen)), s=(CELLS, CELLS))
    return score


def _rasterised(x, y, size):
    """Rasterise points: (k, CELLS, CELLS) float32, 1 in each cell with a point in it."""
    k = len(x)
    column, row = (np.floor(v / size).astype(int) for v in (x, y))
    inside = (np.abs(column) < CELLS // 2) & (np.abs(row) < CELLS // 2)
    place = (np.arange(k)[:, None] * CELLS + row % CELLS) * CELLS + column % CELLS
    grid = np.zeros(k * CELLS * CELLS, dtype=np.float32)
    grid[place[inside]] = 1
    return grid.reshape(k, CELLS, CELLS)


def _peaks(score, turns, size, count):
    """Peaks of the correlation as poses: best cells first, non-maxima near them suppressed."""
    flat = score.ravel()
    best = np.flatnonzero(flat > MIN_PEAK_SHARE * flat.max())
    best = best[np.argsort(-flat[best], kind="stable")[:MAX_PEAK_CELLS]]
    where = np.column_stack(np.unravel_index(best, score.shape))
    where[:, 1:] = (where[:, 1:] + CELLS // 2) % CELLS - CELLS // 2
    found = np.empty((0, 3), dtype=int)
    while len(where) and len(found) < count:
        found = np.vstack([found, where[0]])
        where = where[np.abs(where - where[0]).max(axis=1) > MIN_SEPARATION]
    return np.column_stack([found[:, 2] * size, found[:, 1] * size, turns[found[:, 0]]])
