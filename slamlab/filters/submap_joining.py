"""Submap joining (map joining): local maps, each in its own frame, form a global map (MAK 5.1).

A new submap starts at the last pose of the previous one, with zero covariance; therefore errors of
different submaps are independent.
"""

import numpy as np

from slamlab.filters.kalman_filter import Belief, correct
from slamlab.geometry import compose, transform, wrap


class JoinedMap:
    """Global map joined from submaps, in the frame of the first submap.

    ``x`` (3 + 2N,) contains the pose at the end of the last submap, then the landmarks ``ids``.
    """

    def __init__(self):
        self.x, self.P, self.ids = np.zeros(3), np.zeros((3, 3)), []

    @property
    def pose(self):
        """(3,) the robot's pose at the end of the last submap [m, m, rad], a copy."""
        return self.x[:3].copy()

    def landmarks(self):
        """Return the landmark means (N, 2) [m], in the order of ``ids``, a copy."""
        return self.x[3:].reshape(-1, 2).copy()

    def join(self, submap):
        """Append a submap, a MAK that began at pose 0 with P = 0; merge duplicate landmarks."""
        ids = self.ids + submap.ids
        x, P = self._append_submap(submap)
        duplicates = [i for i in submap.ids if i in self.ids]
        if duplicates:
            H = np.zeros((2 * len(duplicates), len(x)))
            for row, i in enumerate(duplicates):
                first, copy = 3 + 2 * ids.index(i), 3 + 2 * (len(self.ids) + submap.ids.index(i))
                H[2 * row : 2 * row + 2, first : first + 2] = np.eye(2)
                H[2 * row : 2 * row + 2, copy : copy + 2] = -np.eye(2)
            x, P = _merge_duplicates(x, P, H)
        single = [k for k, i in enumerate(ids) if k < len(self.ids) or i not in self.ids]
        rows = np.concatenate([np.arange(3), *([3 + 2 * k, 4 + 2 * k] for k in single)]).astype(int)
        self.x, self.P, self.ids = x[rows], P[np.ix_(rows, rows)], [ids[k] for k in single]

    def _append_submap(self, submap):
        """Append a submap: its point q is at g = base ⊕ q, ∂g/∂base = [I, R⊥ q], ∂g/∂q = R."""
        base, n = self.x[:3], len(self.x)
        c, s = np.cos(base[2]), np.sin(base[2])
        R = np.array([[c, -s], [s, c]])
        local = submap.x
        positions = np.concatenate([local[:2], local[3:]]).reshape(-1, 2)
        # Jacobians of the submap in the global frame, by base and by submap
        by_base, by_submap = np.zeros((len(local), 3)), np.zeros((len(local), len(local)))
        starts = [0, *range(3, len(local), 2)]
        for row, q in zip(starts, positions, strict=True):
            by_base[row : row + 2, :2] = np.eye(2)
            by_base[row : row + 2, 2] = -s * q[0] - c * q[1], c * q[0] - s * q[1]
            by_submap[row : row + 2, row : row + 2] = R
        by_base[2, 2] = by_submap[2, 2] = 1
        end, points = compose(base, local[:3]), transform(base, positions[1:])
        x = np.concatenate([end, self.x[3:], points.ravel()])
        J = np.zeros((len(x), n + len(local)))
        J[:3, :3], J[:3, n:] = by_base[:3], by_submap[:3]
        J[3:n, 3:n] = np.eye(n - 3)
        J[n:, :3], J[n:, n:] = by_base[3:], by_submap[3:]
        P = np.zeros((J.shape[1], J.shape[1]))
        P[:n, :n], P[n:, n:] = self.P, submap.P
        return x, J @ P @ J.T


def _merge_duplicates(x, P, H):
    """Merge duplicates by a noise-free measurement update with the constraint H x = 0."""
    try:
        after, _ = correct(Belief(x, P), -H @ x, H, np.zeros((len(H), len(H))))
    except ValueError:
        raise ValueError("a landmark has zero variance in both maps: remove one of them") from None
    return np.array([*after.x[:2], wrap(after.x[2]), *after.x[3:]]), after.P
