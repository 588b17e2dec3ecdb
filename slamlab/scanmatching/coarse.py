"""Where a surface may lie on another, searched over all turns and all ways at once.

For each turn the source is drawn into a grid of cells and correlated with the target's; the FFT
gives all translations in one go. It knows no minima to fall into, and no more than a cell.
"""

import numpy as np
from scipy import fft

CELLS = 64  # of the grid's side: a power of two suits the FFT
FAR = 0.95  # quantile of the distances that the grid shall hold
WORTH = 0.6  # of the best correlation: less is no candidate
MOST = 2000  # cells looked at for candidates
APART = 2  # cells, and steps of turn, by which two candidates differ at least


def candidates(source, target, initial, turn=np.pi, count=6):
    """The poses at which most of the source's cells meet cells of the target.

    Parameters
    ----------
    source, target : Surface
    initial : (3,) first guess [m, m, rad]
    turn : float, how far from the first guess to turn [rad]
    count : int, poses at most

    Returns
    -------
    (k, 3) poses, the best first [m, m, rad]
    """
    extent = max(np.quantile(source.ranges, FAR), np.quantile(target.ranges, FAR), 1e-9)
    size = 4 * extent / CELLS  # twice the extent for the surface, as much for its way
    # the farthest points then go from cell to cell
    steps = int(np.ceil(min(turn, np.pi) * extent / size / 1.0))
    turns = initial[2] + np.arange(-steps, steps + 1) * (min(turn, np.pi) / max(steps, 1))
    if turn >= np.pi:
        turns = turns[:-1]
    score = correlation(source, target, turns, size)
    return peaks(score, turns, size, count)


def correlation(source, target, turns, size):
    """(k, CELLS, CELLS) how many cells meet, by turn and by way along y and x, both from zero up
    and from minus one down, as the FFT has it."""
    c, s = np.cos(turns)[:, None], np.sin(turns)[:, None]
    seen = drawn(c * source.x - s * source.y, s * source.x + c * source.y, size)
    walls = drawn(target.x[None], target.y[None], size)
    near = sum(np.roll(walls, shift, axis) for axis in (1, 2) for shift in (-1, 1))
    walls = np.maximum(walls, 0.5 * np.minimum(near, 1))
    product = fft.rfft2(walls) * np.conj(fft.rfft2(seen))
    return fft.irfft2(product, s=(CELLS, CELLS))


def drawn(x, y, size):
    """(k, CELLS, CELLS) float32, 1 in each cell that holds a point; those outside are left out."""
    k = len(x)
    column, row = (np.floor(v / size).astype(int) for v in (x, y))
    inside = (np.abs(column) < CELLS // 2) & (np.abs(row) < CELLS // 2)
    place = (np.arange(k)[:, None] * CELLS + row % CELLS) * CELLS + column % CELLS
    grid = np.zeros(k * CELLS * CELLS, dtype=np.float32)
    grid[place[inside]] = 1
    return grid.reshape(k, CELLS, CELLS)


def peaks(score, turns, size, count):
    """The best cells of the correlation that are not neighbours of better ones, as poses."""
    flat = score.ravel()
    best = np.flatnonzero(flat > WORTH * flat.max())
    best = best[np.argsort(-flat[best], kind="stable")[:MOST]]
    where = np.column_stack(np.unravel_index(best, score.shape))
    where[:, 1:] = (where[:, 1:] + CELLS // 2) % CELLS - CELLS // 2
    found = np.empty((0, 3), dtype=int)
    while len(where) and len(found) < count:
        found = np.vstack([found, where[0]])
        where = where[np.abs(where - where[0]).max(axis=1) > APART]
    return np.column_stack([found[:, 2] * size, found[:, 1] * size, turns[found[:, 0]]])
