"""State augmentation: joint state [x_r p_1 … p_N] of robot and landmarks, mean and covariance."""

from copy import copy

import numpy as np

from slamlab.filters.argument_checks import covariance, vector
from slamlab.filters.triangular_covariance import TriangularCovariance

ROBOT_ROWS = np.arange(3)  # of the pose x, y, θ in the state


class AugmentedState:
    """Joint Gaussian of the robot's pose and all landmarks, in preallocated memory."""

    def __init__(self, x, P, capacity):
        self._P = TriangularCovariance(covariance("P", P, 3), 3 + 2 * capacity)
        self._x = np.empty(3 + 2 * capacity)
        self._x[:3] = vector("x", x, 3)
        self._first_estimates = np.empty((0, 2))
        self._row: dict[int, int] = {}

    @property
    def x(self):
        """(3 + 2N,) mean of the state: pose, then landmarks in the order of :attr:`ids`."""
        return self._x[: self._P.n]

    @property
    def pose(self):
        """(3,) mean of the robot's pose [m, m, rad], a copy."""
        return self._x[:3].copy()

    @property
    def P(self):
        """(3 + 2N, 3 + 2N) covariance of the state, symmetric, a copy."""
        return self._P.full()

    @property
    def ids(self):
        """The landmark ids, in the order of the state."""
        return list(self._row)

    def landmarks(self):
        """Return the landmark means (N, 2) [m], a copy."""
        return self.x[3:].reshape(-1, 2).copy()

    def rows(self, ids):
        """Return rows (2m,) of landmarks in x and P. ValueError for unknown or repeated ids."""
        ids = unique_ids(ids)
        try:
            first = [self._row[i] for i in ids]
        except KeyError:
            unknown = [i for i in ids if i not in self._row]
            raise ValueError(f"ids: {unknown} are not in the map; add them first") from None
        return np.array([row for i in first for row in (i, i + 1)], dtype=int)

    def block(self, rows):
        """Return the covariance block (k, k) of given rows of the state; see :meth:`rows`."""
        return self._P.block(np.asarray(rows))

    def blocks(self):
        """Return blocks P_rr (3, 3), P_ir (N, 2, 3), P_ii (N, 2, 2) of the covariance, in O(N)."""
        L = self._P.lower
        i = np.arange(3, self._P.n, 2)
        P_ii = np.empty((len(i), 2, 2))
        P_ii[:, 0, 0], P_ii[:, 1, 1] = L[i, i], L[i + 1, i + 1]
        P_ii[:, 0, 1] = P_ii[:, 1, 0] = L[i + 1, i]
        return self.block(ROBOT_ROWS), L[3:, :3].reshape(-1, 2, 3), P_ii

    def marginal(self, ids):
        """Return the marginal distribution of the robot and some landmarks, as the same class."""
        ids = unique_ids(ids)
        landmarks = self.rows(ids)
        rows = np.concatenate([ROBOT_ROWS, landmarks])
        part = copy(self)
        part._x, part._P = self._x[rows], TriangularCovariance(self.block(rows))
        part._first_estimates = self._first_estimates_of(landmarks)
        part._row = {i: 3 + 2 * k for k, i in enumerate(ids)}
        return part

    def remove(self, ids):
        """Marginalise out (remove) landmarks; the other means and covariances do not change."""
        ids = unique_ids(ids)
        rows = self.rows(ids)
        x = np.delete(self.x, rows)
        self._x[: len(x)] = x
        self._first_estimates = np.delete(self._first_estimates, _landmark_numbers(rows), axis=0)
        self._P.delete(rows)
        gone = set(ids)
        left = [i for i in self._row if i not in gone]
        self._row = {i: 3 + 2 * j for j, i in enumerate(left)}

    def _augment(self, ids, p, cross, corner):
        """Augment the state by landmarks p (k, 2), given their cross-covariance and covariance."""
        n = self._P.n
        self._P.append(cross, corner)
        if self._P.n > len(self._x):
            self._x = np.concatenate([self._x, np.empty(self._P.n)])
        self._x[n : self._P.n] = p.ravel()
        self._first_estimates = np.vstack([self._first_estimates, p])
        self._row.update({i: n + 2 * j for j, i in enumerate(ids)})

    def _first_estimates_of(self, rows):
        return self._first_estimates[_landmark_numbers(rows)]


def _landmark_numbers(rows):
    return (rows[::2] - 3) // 2


def unique_ids(ids):
    """Return the landmark ids of one scan as a list. Raises ValueError if an id is repeated."""
    ids = list(ids)
    if len(set(ids)) < len(ids):
        twice = sorted({i for i in ids if ids.count(i) > 1})
        raise ValueError(f"ids: {twice} occur more than once in one scan")
    return ids
