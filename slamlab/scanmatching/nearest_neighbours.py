"""Nearest neighbours by KD-tree for ICP, with caching between iterations."""

import numpy as np
from scipy.spatial import cKDTree


class NearestNeighbours:
    """Exact nearest-neighbour search (KD-tree) in a target, cached for a source that moves little.

    The tree is built once. A point whose nearest neighbour was d1 away and its second d2 keeps it
    while it moves less than (d2 - d1) / 2, so late rounds, which move little, ask for few points.

    Parameters
    ----------
    target : (m, 2) points [m], m >= 2
    """

    def __init__(self, target):
        self.target = target
        self.tree = cKDTree(target)
        self._queried_at = None

    def __call__(self, source):
        """Query the nearest neighbours: distances to the nearest target points, and their indices.

        Parameters
        ----------
        source : (n, 2) points [m], the same points in each call, moved

        Returns
        -------
        (n,) [m], (n,) int
        """
        if self._queried_at is None:
            self._queried_at = np.array(source)
            self._indices = np.empty(len(source), dtype=int)
            self._margin = np.empty(len(source))
            stale = np.arange(len(source))
        else:
            moved = source - self._queried_at
            stale = np.flatnonzero(np.einsum("ij,ij->i", moved, moved) >= self._margin)
        if len(stale):
            distances, indices = self.tree.query(source[stale], k=2)
            self._queried_at[stale] = source[stale]
            self._indices[stale] = indices[:, 0]
            self._margin[stale] = ((distances[:, 1] - distances[:, 0]) / 2) ** 2
        apart = source - self.target[self._indices]
        return np.sqrt(np.einsum("ij,ij->i", apart, apart)), self._indices.copy()
