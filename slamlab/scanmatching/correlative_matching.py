"""Correlative scan matching by FFT, on one coarse grid in place of a multi-resolution search."""

import numpy as np
from scipy import fft

CELLS = 64  # side of the grid in cells: a power of two for the FFT
EXTENT_QUANTILE = 0.95  # quantile of the ranges that the grid must hold [1]
MIN_PEAK_SHARE = 0.6  # least correlation of a candidate, as a share of the best [1]
MAX_PEAK_CELLS = 2000  # cells of the correlation examined for peaks
TURNS_AT_ONCE = 16  # rotations correlated together, so that their grids fit into the cache
MIN_SEPARATION = 2  # least separation of two peaks, in cells and in steps of the rotation


def candidate_poses(source, target, initial, turn=np.pi, count=6):
    """Return up to ``count`` poses (k, 3) with the largest correlation of two PointClouds, the best
    first. The rotation differs from the initial guess by at most ``turn`` [rad]."""
    extent = max(*(np.quantile(s.ranges, EXTENT_QUANTILE) for s in (source, target)), 1e-9)
    size = 4 * extent / CELLS  # twice the extent for the cloud, as much for its translation
    # one step of the rotation moves the farthest points by one cell
    steps = int(np.ceil(min(turn, np.pi) * extent / size / 1.0))
    turns = initial[2] + np.arange(-steps, steps + 1) * (min(turn, np.pi) / max(steps, 1))
    if turn >= np.pi:
        turns = turns[:-1]
    score = cross_correlation(source, target, turns, size)
    return _peaks(score, turns, size, count)


def cross_correlation(source, target, turns, size):
    """Count the coinciding cells (k, CELLS, CELLS) by rotation and by shift along y and x, with
    negative shifts at the end."""
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
    """Rasterise to (k, CELLS, CELLS) float32, 1 in each cell that contains a point."""
    k = len(x)
    column, row = (np.floor(v / size).astype(int) for v in (x, y))
    inside = (np.abs(column) < CELLS // 2) & (np.abs(row) < CELLS // 2)
    index = (np.arange(k)[:, None] * CELLS + row % CELLS) * CELLS + column % CELLS
    grid = np.zeros(k * CELLS * CELLS, dtype=np.float32)
    grid[index[inside]] = 1
    return grid.reshape(k, CELLS, CELLS)


def _peaks(score, turns, size, count):
    """Return the peaks as poses, with non-maximum suppression."""
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
