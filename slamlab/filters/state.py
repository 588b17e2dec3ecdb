"""The augmented state [x_r p_1 … p_N]: mean, covariance, and which landmark stands where."""

from copy import copy

import numpy as np

from slamlab.filters.guards import covariance, vector
from slamlab.filters.triangle import Triangle

ROBOT = np.arange(3)


class AugmentedState:
    """A robot and its landmarks in one Gaussian, in memory allocated ahead.

    Parameters
    ----------
    x : (3,) pose at the start [m, m, rad]
    P : (3, 3) its covariance
    capacity : int, landmarks to allocate memory for; more may come

    Raises
    ------
    ValueError
    """

    def __init__(self, x, P, capacity):
        self._P = Triangle(covariance("P", P, 3), 3 + 2 * capacity)
        self._x = np.empty(3 + 2 * capacity)
        self._x[:3] = vector("x", x, 3)
        self._first = np.empty((0, 2))
        self._row: dict[int, int] = {}

    @property
    def x(self):
        """(3 + 2N,) pose, then landmarks in the order of :attr:`ids`."""
        return self._x[: self._P.n]

    @property
    def pose(self):
        """(3,) [m, m, rad], a copy."""
        return self._x[:3].copy()

    @property
    def P(self):
        """(3 + 2N, 3 + 2N) the covariance, a copy with both triangles."""
        return self._P.full()

    @property
    def ids(self):
        """The landmarks' ids, in the order of the state."""
        return list(self._row)

    def landmarks(self):
        """(N, 2) the landmarks' means [m], a copy."""
        return self.x[3:].reshape(-1, 2).copy()

    def rows(self, ids):
        """Where landmarks stand in x and P.

        Parameters
        ----------
        ids : (m,) ids

        Returns
        -------
        (2m,) int

        Raises
        ------
        ValueError : an id that is not in the map, or one twice
        """
        ids = distinct(ids)
        try:
            first = [self._row[i] for i in ids]
        except KeyError:
            unknown = [i for i in ids if i not in self._row]
            raise ValueError(f"ids: {unknown} are not in the map; add them first") from None
        return np.array([row for i in first for row in (i, i + 1)], dtype=int)

    def block(self, rows):
        """(k, k) the covariance of some rows of the state, such as those of :meth:`rows`."""
        return self._P.block(np.asarray(rows))

    def blocks(self):
        """What one landmark and the robot share, for all landmarks at once; O(N).

        Returns
        -------
        P_rr (3, 3), P_ir (N, 2, 3), P_ii (N, 2, 2), copies
        """
        L = self._P.lower
        i = np.arange(3, self._P.n, 2)
        P_ii = np.empty((len(i), 2, 2))
        P_ii[:, 0, 0], P_ii[:, 1, 1] = L[i, i], L[i + 1, i + 1]
        P_ii[:, 0, 1] = P_ii[:, 1, 0] = L[i + 1, i]
        return self.block(ROBOT), L[3:, :3].reshape(-1, 2, 3), P_ii

    def part(self, ids):
        """The robot and some of its landmarks, as a state of their own.

        Parameters
        ----------
        ids : (k,) which

        Returns
        -------
        of the same class

        Raises
        ------
        ValueError
        """
        ids = distinct(ids)
        landmarks = self.rows(ids)
        rows = np.concatenate([ROBOT, landmarks])
        part = copy(self)
        part._x, part._P = self._x[rows], Triangle(self.block(rows))
        part._first = self._first_seen(landmarks)
        part._row = {i: 3 + 2 * k for k, i in enumerate(ids)}
        return part

    def remove(self, ids):
        """Drop landmarks; nobody else's mean or covariance changes.

        Parameters
        ----------
        ids : (k,) which

        Raises
        ------
        ValueError
        """
        ids = distinct(ids)
        rows = self.rows(ids)
        x = np.delete(self.x, rows)
        self._x[: len(x)] = x
        self._first = np.delete(self._first, _places(rows), axis=0)
        self._P.delete(rows)
        gone = set(ids)
        left = [i for i in self._row if i not in gone]
        self._row = {i: 3 + 2 * j for j, i in enumerate(left)}

    def _grow(self, ids, p, cross, corner):
        """Append landmarks p (k, 2) with their covariance to all before and among themselves."""
        n = self._P.n
        self._P.append(cross, corner)
        if self._P.n > len(self._x):
            self._x = np.concatenate([self._x, np.empty(self._P.n)])
        self._x[n : self._P.n] = p.ravel()
        self._first = np.vstack([self._first, p])
        self._row.update({i: n + 2 * j for j, i in enumerate(ids)})

    def _first_seen(self, rows):
        """(m, 2) where the landmarks of :meth:`rows` were placed when first seen [m]."""
        return self._first[_places(rows)]


def _places(rows):
    """Which landmarks stand in these rows, counted from the first."""
    return (rows[::2] - 3) // 2


def distinct(ids):
    """Ids of one scan as a list, or an error that names those that stand there twice."""
    ids = list(ids)
    if len(set(ids)) < len(ids):
        twice = sorted({i for i in ids if ids.count(i) > 1})
        raise ValueError(f"ids: {twice} stand more than once in one scan")
    return ids
