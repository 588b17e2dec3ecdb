"""Occupancy grid map by log-odds (Moravec and Elfes 1985): l ← clip(l + log p/(1−p), −L, L). The
clamp ±L lets a cell change again when the environment changes."""

import numpy as np

from slamlab.geometry import transform
from slamlab.layers import OCCUPIED, Grid

# inverse sensor model: probability that a cell is occupied, given a beam that ends in or crosses it
HIT, MISS = 0.7, 0.4
CLAMP = 0.97  # largest probability that a cell is occupied or free
FREE = 0.196  # threshold of the probability below which a cell is free, as in ROS' map_server
MARGIN = 64  # least number of cells added beyond a scan when the grid grows
MAX_CELLS = 100_000_000  # of a grid; more is caused by a wrong pose or range


def log_odds(p):
    """Compute the log-odds (logit) log p/(1−p) of a probability."""
    return np.log(p / (1 - p))


class OccupancyGrid:
    """Occupancy grid: the log-odds that each cell is occupied; 0 means unknown. Raises ValueError.

    Parameters
    ----------
    resolution : float, side of a cell [m]
    corner : (2,) a point where four cells meet [m]
    """

    def __init__(self, resolution=0.05, corner=(0.0, 0.0)):
        if not 0 < resolution < np.inf:
            raise ValueError(f"resolution must be above 0 m, got {resolution}")
        self.resolution, self.corner = float(resolution), np.array(corner, dtype=float)
        self._buffer = np.zeros((0, 0), np.float32)
        self._buffer_corner = np.zeros(2, dtype=int)  # the buffer's first cell
        self._low = self._high = np.zeros(2, dtype=int)  # observed cells: low ≤ cell < high

    @property
    def log_odds(self):
        """Log-odds (rows, columns) of the observed cells; row 0 lowest, column 0 leftmost."""
        (i0, j0), (i1, j1) = self._low - self._buffer_corner, self._high - self._buffer_corner
        return self._buffer[j0:j1, i0:i1]

    @property
    def origin(self):
        """Lower left corner (2,) of the cell in row 0 and column 0 [m]."""
        return self.corner + self.resolution * self._low

    @property
    def probability(self):
        """Occupancy probabilities (rows, columns); 0.5 means unknown."""
        return 1 / (1 + np.exp(-self.log_odds))

    @property
    def states(self):
        """(rows, columns) int8: 1 occupied, 0 free, −1 unknown."""
        p = self.probability
        return np.select([p > OCCUPIED, p < FREE], [1, 0], -1).astype(np.int8)

    def add(self, pose, scan):
        """Update the log-odds by a scan at a pose (3,): occupied where a beam ends, free where
        beams pass; each cell once (inverse sensor model). Equation (15.11). Raises ValueError if
        the pose is not finite or the map is too large."""
        if not np.isfinite(pose).all():
            raise ValueError(f"the pose of a scan must be finite, got {pose}")
        start, *ends = self._to_cells(np.vstack([pose[:2], transform(pose, scan.points())]))
        if not ends:
            return
        ends = np.array(ends)
        hit = np.floor(ends).astype(int)
        self._grow(np.vstack([hit, np.floor(start).astype(int)]))
        l, most = self._buffer.reshape(-1), log_odds(CLAMP)
        hit, passed = self._flat_index(hit), self._flat_index(crossed_cells(start, ends))
        # repeated indices write the same number, so each cell is updated once
        after = np.minimum(l[hit] + log_odds(HIT), most)
        l[passed] = np.maximum(l[passed] + log_odds(MISS), -most)
        l[hit] = after

    def set(self, states):
        """Set cells to ±L or 0 by states (rows, columns); ``corner`` is the lower left cell."""
        states = np.asarray(states)
        most = log_odds(CLAMP)
        known = np.select([states == 1, states == 0], [most, -most], 0.0)
        self._buffer = known.astype(np.float32)
        self._buffer_corner = self._low = np.zeros(2, dtype=int)
        self._high = np.array(states.shape[::-1])

    def layer(self, name="map"):
        return Grid(name, self.probability, self.origin, self.resolution)

    def _to_cells(self, xy):
        return (xy - self.corner) / self.resolution

    def _flat_index(self, cells):
        i, j = (cells - self._buffer_corner).T
        return j * self._buffer.shape[1] + i

    def _grow(self, cells):
        """Enlarge the buffer so that it contains the given cells and a margin."""
        low, high = cells.min(axis=0), cells.max(axis=0) + 1
        if self._buffer.size:
            low, high = np.minimum(low, self._low), np.maximum(high, self._high)
        else:
            self._buffer_corner = low
        size = np.array(self._buffer.shape[::-1])
        if (low < self._buffer_corner).any() or (high > self._buffer_corner + size).any():
            more = np.maximum(MARGIN, (high - low) // 4)
            at = np.where(low < self._buffer_corner, low - more, self._buffer_corner)
            end = self._buffer_corner + size
            end = np.where(high > end, high + more, end)
            columns, rows = end - at
            if columns * float(rows) > MAX_CELLS:
                raise ValueError(
                    f"a map of {rows} × {columns} cells is too large: a pose or a range is wrong, "
                    f"or cells of {self.resolution} m are too small"
                )
            grown = np.zeros((rows, columns), np.float32)
            i, j = self._buffer_corner - at
            grown[j : j + size[1], i : i + size[0]] = self._buffer
            self._buffer, self._buffer_corner = grown, at
        self._low, self._high = low, high


def build(poses, scans, resolution=0.05):
    """Build an occupancy grid from scans. Returns an OccupancyGrid.

    Parameters
    ----------
    poses : (n, 3) of the sensor [m, m, rad]
    scans : n Scans
    resolution : float, side of a cell [m]
    """
    grid = OccupancyGrid(resolution)
    for pose, scan in zip(poses, scans, strict=True):
        grid.add(pose, scan)
    return grid


def crossed_cells(start, ends):
    """Ray traversal: return the cells (m, 2) that rays from ``start`` (2,) to ``ends`` (n, 2)
    cross, without the last cell of each ray. Cells may be repeated. The traversal is exact and
    vectorised (after Amanatides and Woo 1987)."""
    start, ends = np.asarray(start, dtype=float), np.asarray(ends, dtype=float).reshape(-1, 2)
    first, last = np.floor(start).astype(int), np.floor(ends).astype(int)
    left = (last != first).any()  # whether any ray leaves the first cell
    entered = (_cells_entered(start, ends, first, last, axis) for axis in (0, 1))
    return np.concatenate([np.repeat(first[None], left, axis=0), *entered])


def _cells_entered(start, ends, first, last, axis):
    """Return cells entered across grid lines of one axis: crossing line k enters ``first`` ± k."""
    count = np.abs(last - first)[:, axis]
    ray = np.repeat(np.arange(len(ends)), count)
    k = np.arange(len(ray)) - np.repeat(np.cumsum(count) - count, count)  # lines crossed before
    towards = np.sign(last - first)[:, axis][ray]
    # a ray enters a cell upwards by its lower edge, downwards by its upper edge
    line = first[axis] + towards * k + (towards > 0)
    direction = (ends - start)[ray]
    t = (line - start[axis]) / direction[:, axis]
    other = 1 - axis
    cells = np.empty((len(ray), 2), dtype=int)
    cells[:, axis] = first[axis] + towards * (k + 1)
    # rounding must not leave the bounding box of a ray
    low = np.minimum(first[other], last[:, other])[ray]
    high = np.maximum(first[other], last[:, other])[ray]
    height = np.floor(start[other] + t * direction[:, other]).astype(int)
    cells[:, other] = np.clip(height, low, high)
    return cells[(cells != last[ray]).any(axis=1)]
