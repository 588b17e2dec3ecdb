"""Downsample a point cloud: no two kept points lie close together (Smolec §4.5)."""

import numpy as np


class DownsampledPoints:
    """A downsampled point cloud: points keep a distance; a grid of cells (voxels) finds neighbours.

    Parameters
    ----------
    spacing : float, a point nearer than this to one that is kept is left out [m]
    """

    def __init__(self, spacing=0.06):
        if not spacing > 0:
            raise ValueError(f"spacing is above zero, not {spacing}")
        self.spacing = spacing
        self._cells: dict[tuple[int, int], list[tuple[float, float]]] = {}
        self._points: list[tuple[float, float]] = []

    @property
    def xy(self):
        """(n, 2) the downsampled points, in the order they came [m]."""
        return np.array(self._points).reshape(-1, 2)

    def add(self, points):
        """Add points, downsampled: only those far enough from all that are kept.

        Parameters
        ----------
        points : (n, 2) [m]

        Returns
        -------
        int, how many were kept
        """
        before = len(self._points)
        cells = np.floor(np.asarray(points) / self.spacing).astype(int).tolist()
        for (x, y), (i, j) in zip(np.asarray(points).tolist(), cells, strict=True):
            if not self._has_neighbour(x, y, i, j):
                self._points.append((x, y))
                self._cells.setdefault((i, j), []).append((x, y))
        return len(self._points) - before

    def _has_neighbour(self, x, y, i, j):
        least = self.spacing**2
        for a in (i - 1, i, i + 1):
            for b in (j - 1, j, j + 1):
                for u, v in self._cells.get((a, b), ()):
                    if (u - x) ** 2 + (v - y) ** 2 <= least:
                        return True
        return False


Thinned = DownsampledPoints  # name in the first edition
