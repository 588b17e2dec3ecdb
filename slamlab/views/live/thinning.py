"""Thinning (voxel filter) of large clouds: a picture's cost is bounded by the rooms that it shows.

A map of scans grows as long as a robot drives, also where it has been before. Of a large one a
point a cell is drawn, so that the hundredth lap takes no longer than the second.
"""

from dataclasses import replace

import numpy as np

from slamlab.layers import Points

CELL = 0.01  # side of the cells of which one point is drawn [m]
MANY = 20_000  # points, up to which all are drawn
PROBES = 64  # points by which a cloud is known again
_ROW = np.int64(1) << 32  # one more than there are cells in a row of the plane


class Thinning:
    """Thinning of the clouds of a scene: each large one is gone through once, as it grows."""

    def __init__(self):
        self._clouds = {}

    def __call__(self, layers):
        """Layers as they are, but of large clouds one point a cell.

        Parameters
        ----------
        layers : list of Layer

        Returns
        -------
        list of Layer
        """
        return [self._thinned(each) if isinstance(each, Points) else each for each in layers]

    def _thinned(self, layer):
        if len(layer.xy) <= MANY:
            return layer
        cloud = self._clouds.setdefault(layer.name, ThinnedCloud())
        return replace(layer, xy=cloud.of(np.asarray(layer.xy, dtype=float)))


class ThinnedCloud:
    """One point a cell of a cloud, the first one there; begun anew where it is another cloud."""

    def __init__(self):
        self._begin()

    def of(self, xy):
        """The points of a cloud that are drawn; where it has only grown they stay, others follow.

        Parameters
        ----------
        xy : (n, 2) [m]

        Returns
        -------
        (m, 2) [m], in the cloud's order
        """
        if len(xy) < self._count or not np.array_equal(xy[self._at], self._probes):
            self._begin()
        if len(xy) > self._count:
            self._drawn = np.concatenate([self._drawn, self._cells.add(xy[self._count :])])
        self._count = len(xy)
        self._at = np.linspace(0, self._count - 1, PROBES).astype(int)
        self._probes = xy[self._at]
        return self._drawn

    def _begin(self):
        self._cells, self._count, self._at = FirstOfCells(CELL), 0, np.empty(0, int)
        self._drawn = self._probes = np.empty((0, 2))


class FirstOfCells:
    """A voxel filter that is asked again and again: of every cell the first point ever seen.

    Parameters
    ----------
    side : float, side of a cell [m]
    """

    def __init__(self, side):
        if not side > 0:
            raise ValueError(f"the side of a cell is above zero, not {side}")
        self.side = side
        self._known: set[int] = set()

    def add(self, points):
        """Take more points, and give those that are the first of their cell.

        Parameters
        ----------
        points : (n, 2) [m]; what is not finite has no cell

        Returns
        -------
        (m, 2) [m], in the order they came
        """
        points = points[np.isfinite(points).all(axis=1)]
        cells = np.floor(points / self.side).astype(np.int64)
        keys, first = np.unique(cells[:, 0] * _ROW + cells[:, 1], return_index=True)
        new = [at for key, at in zip(keys.tolist(), first, strict=True) if key not in self._known]
        self._known.update(keys.tolist())
        return points[np.sort(np.array(new, dtype=int))]
