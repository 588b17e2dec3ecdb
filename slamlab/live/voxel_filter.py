"""Voxel filter: downsamples large point clouds, so that drawing time stays bounded."""

from dataclasses import replace

import numpy as np

from slamlab.layers import Points

CELL = 0.01  # side of a cell; one point of each is drawn [m]
MANY = 20_000  # points; smaller clouds are drawn whole
PROBES = 64  # points by which a cloud is recognised
_ROW = np.int64(1) << 32  # one more than there are cells in a row of the plane


class CloudDownsampling:
    """Replaces each large cloud of a scene with one point per cell."""

    def __init__(self):
        self._clouds = {}

    def __call__(self, layers):
        return [self._downsampled(each) if isinstance(each, Points) else each for each in layers]

    def _downsampled(self, layer):
        if len(layer.xy) <= MANY:
            return layer
        cloud = self._clouds.setdefault(layer.name, DownsampledCloud())
        return replace(layer, xy=cloud.of(np.asarray(layer.xy, dtype=float)))


class DownsampledCloud:
    """Finds the first point in each cell of a growing cloud; starts again for another cloud."""

    def __init__(self):
        self._start()

    def of(self, xy):
        """Return the points (m, 2) [m] of a cloud (n, 2) to draw; they stay as the cloud grows."""
        if len(xy) < self._count or not np.array_equal(xy[self._at], self._probes):
            self._start()
        if len(xy) > self._count:
            self._drawn = np.concatenate([self._drawn, self._cells.add(xy[self._count :])])
        self._count = len(xy)
        self._at = np.linspace(0, self._count - 1, PROBES).astype(int)
        self._probes = xy[self._at]
        return self._drawn

    def _start(self):
        self._cells, self._count, self._at = VoxelFilter(CELL), 0, np.empty(0, int)
        self._drawn = self._probes = np.empty((0, 2))


class VoxelFilter:
    """Voxel filter: keeps the first point in every cell of the given side [m]."""

    def __init__(self, side):
        if not side > 0:
            raise ValueError(f"the side of a cell must be greater than zero, not {side}")
        self.side = side
        self._known: set[int] = set()

    def add(self, points):
        """Add points (n, 2) [m]; return those that are the first in their cell."""
        points = points[np.isfinite(points).all(axis=1)]
        cells = np.floor(points / self.side).astype(np.int64)
        keys, first = np.unique(cells[:, 0] * _ROW + cells[:, 1], return_index=True)
        new = [at for key, at in zip(keys.tolist(), first, strict=True) if key not in self._known]
        self._known.update(keys.tolist())
        return points[np.sort(np.array(new, dtype=int))]
