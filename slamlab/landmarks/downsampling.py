"""Downsampling of a point cloud to a minimum distance between points (voxel grid; Smolec §4.5)."""

import numpy as np


class DownsampledPoints:
    """Points with a minimum distance of ``spacing`` [m], selected by a grid of cells (voxels)."""

    def __init__(self, spacing=0.06):
        if not spacing > 0:
            raise ValueError(f"spacing must be above zero, not {spacing}")
        self.spacing = spacing
        self._cells: dict[tuple[int, int], list[tuple[float, float]]] = {}
        self._points: list[tuple[float, float]] = []

    @property
    def xy(self):
        """The kept points (n, 2) [m], in the order in which they were added."""
        return np.array(self._points).reshape(-1, 2)

    def add(self, points):
        """Add the points of (n, 2) that keep the minimum distance, and return their number."""
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
