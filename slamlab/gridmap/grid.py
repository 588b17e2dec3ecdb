"""An occupancy grid by log odds (Moravec and Elfes 1985), clamped so that it can change its mind.

l ← clip(l + log p/(1−p), −L, L): p of a hit where a beam ends, of a miss where it passes. Without
the clamp a wall seen a thousand times would have to be missed two thousand times; with it a door
that was opened is free after some scans, and a chair that went away is gone.
"""

import numpy as np

from slamlab.geometry import transform
from slamlab.gridmap.rays import crossed
from slamlab.layers import OCCUPIED, Grid

HIT, MISS = 0.7, 0.4  # that a cell is occupied, told by one scan that ends in it or crosses it
CERTAIN = 0.97  # no cell is believed more occupied, or more free, than this
FREE = 0.196  # below this a cell is called free, as by ROS' map_server
MARGIN = 64  # cells added beyond what a scan needs, at least
MOST = 100_000_000  # cells; more means that a pose or a range is wrong


def log_odds(p):
    """log p/(1−p) of a probability."""
    return np.log(p / (1 - p))


class OccupancyGrid:
    """Cells of a plane, each with the log odds that it is occupied; 0 where nothing is known.

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
            raise ValueError(f"a cell is wider than 0 m, not {resolution}")
        self.resolution, self.corner = float(resolution), np.array(corner, dtype=float)
        self._buffer, self._at = (
            np.zeros((0, 0), np.float32),
            np.zeros(2, dtype=int),
        )  # its first cell
        self._low = self._high = np.zeros(2, dtype=int)  # cells seen: from low to before high

    @property
    def log_odds(self):
        """(rows, columns) of all cells seen so far; row 0 lies lowest, column 0 leftmost."""
        (i0, j0), (i1, j1) = self._low - self._at, self._high - self._at
        return self._buffer[j0:j1, i0:i1]

    @property
    def origin(self):
        """(2,) lower left corner of the cell in row 0, column 0 [m]."""
        return self.corner + self.resolution * self._low

    @property
    def probability(self):
        """(rows, columns) that a cell is occupied; 0.5 where nothing is known."""
        return 1 / (1 + np.exp(-self.log_odds))

    @property
    def states(self):
        """(rows, columns) int8: 1 occupied, 0 free, −1 unknown or undecided."""
        p = self.probability
        return np.select([p > OCCUPIED, p < FREE], [1, 0], -1).astype(np.int8)

    def add(self, pose, scan):
        """Enter a scan: where beams end is less free, where they pass is less occupied.

        Each cell changes once a scan, however many beams meet it; one that a beam ends in counts as
        hit, even if others pass. Beams without a return tell nothing.

        Parameters
        ----------
        pose : (3,) of the sensor [m, m, rad]
        scan : Scan

        Raises
        ------
        ValueError : the pose is not finite; the map would become too large to hold
        """
        if not np.isfinite(pose).all():
            raise ValueError(f"a scan cannot be entered at the pose {pose}: it is not finite")
        start, *ends = self._cells(np.vstack([pose[:2], transform(pose, scan.points())]))
        if not ends:
            return
        ends = np.array(ends)
        hit = np.floor(ends).astype(int)
        self._cover(np.vstack([hit, np.floor(start).astype(int)]))
        l, most = self._buffer.reshape(-1), log_odds(CERTAIN)
        hit, passed = self._flat(hit), self._flat(crossed(start, ends))
        # a cell named twice is written twice with the same number: it changes once
        after = np.minimum(l[hit] + log_odds(HIT), most)
        l[passed] = np.maximum(l[passed] + log_odds(MISS), -most)
        l[hit] = after

    def set(self, states):
        """Take states over, each as certain as can be: a map made before.

        Parameters
        ----------
        states : (rows, columns) 1 occupied, 0 free, −1 unknown; its lower left cell at ``corner``
        """
        states = np.asarray(states)
        most = log_odds(CERTAIN)
        known = np.select([states == 1, states == 0], [most, -most], 0.0)
        self._buffer = known.astype(np.float32)
        self._at = self._low = np.zeros(2, dtype=int)
        self._high = np.array(states.shape[::-1])

    def layer(self, name="map"):
        """The grid as a layer to draw.

        Parameters
        ----------
        name : str

        Returns
        -------
        Grid
        """
        return Grid(name, self.probability, self.origin, self.resolution)

    def _cells(self, xy):
        """Places as numbers of cells."""
        return (xy - self.corner) / self.resolution

    def _flat(self, cells):
        """Where cells stand in the buffer."""
        i, j = (cells - self._at).T
        return j * self._buffer.shape[1] + i

    def _cover(self, cells):
        """Make room for cells, twice as much as there was, so that growing stays rare."""
        low, high = cells.min(axis=0), cells.max(axis=0) + 1
        if self._buffer.size:
            low, high = np.minimum(low, self._low), np.maximum(high, self._high)
        else:
            self._at = low
        size = np.array(self._buffer.shape[::-1])
        if (low < self._at).any() or (high > self._at + size).any():
            more = np.maximum(MARGIN, (high - low) // 4)
            at = np.where(low < self._at, low - more, self._at)
            end = np.where(high > self._at + size, high + more, self._at + size)
            columns, rows = end - at
            if columns * float(rows) > MOST:
                raise ValueError(
                    f"a map of {rows} × {columns} cells cannot be held: a pose or a range is "
                    f"wrong, or cells of {self.resolution} m are too small"
                )
            grown = np.zeros((rows, columns), np.float32)
            i, j = self._at - at
            grown[j : j + size[1], i : i + size[0]] = self._buffer
            self._buffer, self._at = grown, at
        self._low, self._high = low, high


def build(poses, scans, resolution=0.05):
    """A grid of many scans, made anew when a graph has revised their poses.

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
