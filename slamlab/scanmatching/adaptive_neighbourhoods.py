"""Adaptive neighbourhoods in a point cloud, which are larger than its noise. In merged revolutions,
nearest neighbours differ across the wall as much as along it, or they belong to the same beam."""

from dataclasses import dataclass
from functools import cached_property
from math import nan, sqrt

import numpy as np

from slamlab.scanmatching.quantiles import median

# ratios of the standard deviations across and along a line [1]: noise, a beam, a long enough line
NOISY = 0.25
STRAIGHT = 0.02
LONG = 0.17  # a line as long as 20 standard deviations of the noise
SAME_LINE = 0.7  # least cosine between two line fits of different size to one wall [1]
TIMES, SHARE = 4, 0.04  # size of the first larger neighbourhood: factor, and share of all points
MAX_SHARE = 0.125  # largest median share of the points in a neighbourhood [1]
GROWTH = 1.4  # factor from size to size
SAMPLE = 64  # points that determine the first size


@dataclass(frozen=True)
class GridNeighbourhoods:
    """Neighbourhoods of 3 × 3 cells of a grid: the ``count`` (c,) of points, ``means`` (5, c) of x,
    y, x², y², xy relative to the ``centre`` (2, c) of the cell [m], ``cell`` (n,) of each point."""

    count: np.ndarray
    means: np.ndarray
    centre: np.ndarray
    cell: np.ndarray

    @cached_property
    def axes(self):
        """The principal axes of the neighbourhoods; see ``principal_axes``."""
        x, y, xx, yy, xy = self.means
        return principal_axes(xx - x * x, yy - y * y, xy - x * y)


def grid_neighbourhoods(points, side):
    """Return the GridNeighbourhoods of points (n, 2), for cells with the given side [m]."""
    column, row = np.floor((points - points.min(axis=0)) / side).astype(np.int64).T
    stride = row.max() + 3  # the end of a column is not adjacent to the beginning of the next
    keys, first, cell = np.unique(column * stride + row, return_index=True, return_inverse=True)
    centre = points.min(axis=0)[:, None] + (np.array([column[first], row[first]]) + 0.5) * side
    x, y = points.T - centre[:, cell]
    own = np.array([np.bincount(cell, v) for v in (np.ones_like(x), x, y, x * x, y * y, x * y)])
    total = np.zeros_like(own)
    for i in (-1, 0, 1):
        for j in (-1, 0, 1):
            index = np.minimum(keys.searchsorted(keys + i * stride + j), len(keys) - 1)
            n, x, y, xx, yy, xy = own[:, index] * (keys[index] == keys + i * stride + j)
            u, v = i * side, j * side
            xx, yy, xy = xx + 2 * u * x, yy + 2 * v * y, xy + u * y + v * x
            total += n, x + u * n, y + v * n, xx + u * u * n, yy + v * v * n, xy + u * v * n
    return GridNeighbourhoods(total[0], total[1:] / total[0], centre, cell)


def principal_axes(s_xx, s_yy, s_xy):
    """Principal component analysis: directions (n,) [rad], variances across and along lines."""
    direction = 0.5 * np.arctan2(2 * s_xy, s_xx - s_yy)
    middle, half = (s_xx + s_yy) / 2, np.hypot((s_xx - s_yy) / 2, s_xy)
    return direction, middle - half, middle + half


def neighbourhoods_above_noise(tree, points, lines, count, largest=np.inf):
    """Return GridNeighbourhoods so large that their line fits are longer than the noise is wide.
    Return None if ``count`` nearest neighbours suffice, which the principal axes of ``lines`` show,
    or if no size suffices."""
    usual = _roundness(lines)
    if not (usual < STRAIGHT or usual > NOISY) or len(points) < 2 * count:
        return None
    k = round(min(max(TIMES * count, SHARE * len(points)), len(points)))
    distances, _ = tree.query(points[:: max(1, len(points) // SAMPLE)], k=[k])
    side, best, least = float(np.median(distances)) / 1.5, None, NOISY
    while 0 < side < largest:
        tried = grid_neighbourhoods(points, side)
        if np.median(tried.count[tried.cell]) > MAX_SHARE * len(points):
            break
        axes = [v[tried.cell] for v in tried.axes]
        if best is None and usual < STRAIGHT and _parallel(lines, axes):
            break
        roundness = _roundness(axes)
        if roundness < least:
            best, least = tried, roundness
        if least < LONG:
            break
        side *= GROWTH
    return best


def _roundness(lines):
    """Return the median ratio of deviations across and along lines; NaN if most lack a line."""
    _, across, along = lines
    known = along > across
    shares = across[known] / along[known]
    return sqrt(max(median(shares), 0.0)) if 2 * len(shares) > len(across) else nan


def _parallel(lines, others):
    """Whether line fits of two cell sizes usually have the same direction."""
    return median(np.abs(np.cos(lines[0] - others[0]))) > SAME_LINE
