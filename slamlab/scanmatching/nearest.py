"""Nearest neighbours of a cloud that moves a little each round."""

import numpy as np
from scipy.spatial import cKDTree


class Nearest:
    """Exact nearest neighbours in a target, asked again and again for the same moving source.

    The tree is built once. A point whose nearest neighbour was d1 away and its second d2 keeps it
    while it moves less than (d2 - d1) / 2, so late rounds, which move little, ask for few points.

    Parameters
    ----------
    target : (m, 2) points [m], m >= 2
    """

    def __init__(self, target):
        self.target = target
        self.tree = cKDTree(target)
        self._asked_at = None

    def __call__(self, source):
        """Distances to and indices of the nearest target points.

        Parameters
        ----------
        source : (n, 2) points [m], the same points in each call, moved

        Returns
        -------
        (n,) [m], (n,) int
        """
        if self._asked_at is None:
            self._asked_at = np.array(source)
            self._indices = np.empty(len(source), dtype=int)
            self._slack = np.empty(len(source))
            stale = np.arange(len(source))
        else:
            moved = source - self._asked_at
            stale = np.flatnonzero(np.einsum("ij,ij->i", moved, moved) >= self._slack)
        if len(stale):
            distances, indices = self.tree.query(source[stale], k=2)
            self._asked_at[stale] = source[stale]
            self._indices[stale] = indices[:, 0]
            self._slack[stale] = ((distances[:, 1] - distances[:, 0]) / 2) ** 2
        apart = source - self.target[self._indices]
        return np.sqrt(np.einsum("ij,ij->i", apart, apart)), self._indices.copy()
