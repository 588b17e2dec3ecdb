"""Nearest neighbours for ICP by a k-d tree, cached between iterations."""

import numpy as np
from scipy.spatial import cKDTree


class NearestNeighbours:
    """Exact nearest neighbours in a target (m, 2), m >= 2. With distances d1, d2 of the nearest and
    the second point, the nearest stays the same while a point moves by less than (d2 - d1) / 2."""

    def __init__(self, target):
        self.target = target
        self.tree = cKDTree(target)
        self._queried_at = None

    def __call__(self, source):
        """Return distances (n,) [m] and indices (n,) of n points, the same points in each call."""
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
