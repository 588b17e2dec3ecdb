"""Occupancy grid map by log-odds (Moravec and Elfes 1985), clamped so that it can be updated.

l ← clip(l + log p/(1−p), −L, L): p of a hit where a beam ends, of a miss where it passes. Without
the clamping a wall seen a thousand times would have to be missed two thousand times; with it a door
that was opened is free after some scans, and a chair that went away is gone.
"""

import numpy as np

from slamlab.geometry import transform
from slamlab.gridmap.ray_traversal import crossed_cells
from slamlab.layers import OCCUPIED, Grid

# inverse sensor model: probability that a cell is occupied, given a beam that ends in or crosses it
HIT, MISS = 0.7, 0.4
CLAMP = 0.97  # largest probability that a cell is occupied, or free
CERTAIN = CLAMP  # name in the first edition
FREE = 0.196  # threshold of the probability below which a cell is free, as in ROS' map_server
MARGIN = 64  # cells added beyond what a scan needs, at least
MAX_CELLS = 100_000_000  # of a grid: more means that a pose or a range is wrong


def log_odds(p):
    """Log-odds (log odds, logit) log p/(1−p) of a probability."""
    return np.log(p / (1 - p))


class OccupancyGrid:
    """Occupancy grid: cells of the plane, each with the log-odds of occupied; 0 is unknown.

    Parameters
    ----------
    resolution : float, side of a cell [m]
    corner : (2,) a place where four cells meet [m]

    Raises
    ------
    ValueError : the resolution is not above zero
    """

    def __init__(self, resolution=0.05, corner=(0.0, 0.0)):
        if not 0 < resolution < np.inf:
            raise ValueError(f"resolution must be above 0 m, got {resolution}")
        self.resolution, self.corner = float(resolution), np.array(corner, dtype=float)
        self._buffer = np.zeros((0, 0), np.float32)
        self._buffer_corner = np.zeros(2, dtype=int)  # the buffer's first cell
        self._low = self._high = np.zeros(2, dtype=int)  # cells seen: from low to before high

    @property
    def log_odds(self):
        """Log-odds (rows, columns) of all cells seen so far; row 0 lowest, column 0 leftmost."""
        (i0, j0), (i1, j1) = self._low - self._buffer_corner, self._high - self._buffer_corner
        return self._buffer[j0:j1, i0:i1]

    @property
    def origin(self):
        """Origin (2,): lower left corner of the cell in row 0, column 0 [m]."""
        return self.corner + self.resolution * self._low

    @property
    def probability(self):
        """Occupancy probability (rows, columns); 0.5 where nothing is known."""
        return 1 / (1 + np.exp(-self.log_odds))

    @property
    def states(self):
        """Occupancy states (rows, columns) int8: 1 occupied, 0 free, −1 unknown or undecided."""
        p = self.probability
        return np.select([p > OCCUPIED, p < FREE], [1, 0], -1).astype(np.int8)

    def add(self, pose, scan):
        """Update the occupancy grid with a scan: beams hit where they end, free where they pass.

        Each cell changes once a scan, however many beams meet it; one that a beam ends in counts as
        hit, even if others pass. Beams without a return tell nothing. Equation (15.11).

        Parameters
        ----------
        pose : (3,) of the sensor [m, m, rad]
        scan : Scan

        Raises
        ------
        ValueError : the pose is not finite; the map would become too large to hold
        """
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
        # a cell named twice is written twice with the same number: it changes once
        after = np.minimum(l[hit] + log_odds(HIT), most)
        l[passed] = np.maximum(l[passed] + log_odds(MISS), -most)
        l[hit] = after

    def set(self, states):
        """Set the states of a map made before, each at the clamp of the log-odds.

        Parameters
        ----------
        states : (rows, columns) 1 occupied, 0 free, −1 unknown; its lower left cell at ``corner``
        """
        states = np.asarray(states)
        most = log_odds(CLAMP)
        known = np.select([states == 1, states == 0], [most, -most], 0.0)
        self._buffer = known.astype(np.float32)
        self._buffer_corner = self._low = np.zeros(2, dtype=int)
        self._high = np.array(states.shape[::-1])

    def layer(self, name="map"):
        """Convert the occupancy grid to a layer to draw.

        Parameters
        ----------
        name : str

        Returns
        -------
        Grid
        """
        return Grid(name, self.probability, self.origin, self.resolution)

    def _to_cells(self, xy):
        """Cell coordinates of points (not rounded)."""
        return (xy - self.corner) / self.resolution

    def _flat_index(self, cells):
        """Flat index of cells in the buffer."""
        i, j = (cells - self._buffer_corner).T
        return j * self._buffer.shape[1] + i

    def _grow(self, cells):
        """Grow the buffer to hold cells, with room to spare so that growing stays rare."""
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
                    f"a map of {rows} × {columns} cells cannot be held: a pose or a range is "
                    f"wrong, or cells of {self.resolution} m are too small"
                )
            grown = np.zeros((rows, columns), np.float32)
            i, j = self._buffer_corner - at
            grown[j : j + size[1], i : i + size[0]] = self._buffer
            self._buffer, self._buffer_corner = grown, at
        self._low, self._high = low, high


def build(poses, scans, resolution=0.05):
    """Build an occupancy grid from many scans, anew when pose-graph optimisation moved their poses.

    Parameters
    ----------
    poses : (n, 3) of the sensor [m, m, rad]
    scans : n Scans
    resolution : float, side of a cell [m]

    Returns
    -------
    OccupancyGrid
    """
    grid = OccupancyGrid(resolution)
    for pose, scan in zip(poses, scans, strict=True):
        grid.add(pose, scan)
    return grid
