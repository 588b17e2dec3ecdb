"""MAK on groups: small maps, each in a frame of its own, joined into one (MAK thesis, 5.1).

While a group is filtered, nothing outside it is touched. A new group starts where the last one
ended, sure of its pose: its errors are independent of all that was, so joining needs no old noise.
"""

import numpy as np

from slamlab.filters.linear import Belief, correct
from slamlab.geometry import compose, transform, wrap


class Joined:
    """The whole map, in the frame of the first group; grows by one group at a time.

    ``x`` (3 + 2N,) is the robot at the end of the last group and the landmarks [m, rad], ``P`` its
    covariance, ``ids`` the landmarks' ids in that order.
    """

    def __init__(self):
        self.x, self.P, self.ids = np.zeros(3), np.zeros((3, 3)), []

    @property
    def pose(self):
        """(3,) the robot at the end of the last group [m, m, rad], a copy."""
        return self.x[:3].copy()

    def landmarks(self):
        """(N, 2) the landmarks' means, in the order of ``ids`` [m], a copy."""
        return self.x[3:].reshape(-1, 2).copy()

    def join(self, group):
        """Take a finished group in: lay it where the last one ended, then merge what both hold.

        Parameters
        ----------
        group : MAK that started at pose (0, 0, 0) with covariance 0

        Raises
        ------
        ValueError : a landmark that both know without error, so that they cannot be merged
        """
        ids = self.ids + group.ids
        x, P = self._laid(group)
        twice = [i for i in group.ids if i in self.ids]
        if twice:
            H = np.zeros((2 * len(twice), len(x)))
            for row, i in enumerate(twice):
                first, copy = 3 + 2 * ids.index(i), 3 + 2 * (len(self.ids) + group.ids.index(i))
                H[2 * row : 2 * row + 2, first : first + 2] = np.eye(2)
                H[2 * row : 2 * row + 2, copy : copy + 2] = -np.eye(2)
            x, P = _merged(x, P, H)
        single = [k for k, i in enumerate(ids) if k < len(self.ids) or i not in self.ids]
        rows = np.concatenate([np.arange(3), *([3 + 2 * k, 4 + 2 * k] for k in single)]).astype(int)
        self.x, self.P, self.ids = x[rows], P[np.ix_(rows, rows)], [ids[k] for k in single]

    def _laid(self, group):
        """State and covariance with the group appended, landmarks known already as copies.

        A point q of the group stands at g = base ⊕ q:  ∂g/∂base = [I, R⊥ q],  ∂g/∂q = R.
        """
        base, n = self.x[:3], len(self.x)
        c, s = np.cos(base[2]), np.sin(base[2])
        R = np.array([[c, -s], [s, c]])
        local = group.x
        places = np.concatenate([local[:2], local[3:]]).reshape(-1, 2)
        # ∂(all of the group, in the frame of the whole)/∂base and /∂group
        by_base, by_group = np.zeros((len(local), 3)), np.zeros((len(local), len(local)))
        starts = [0, *range(3, len(local), 2)]
        for row, q in zip(starts, places, strict=True):
            by_base[row : row + 2, :2] = np.eye(2)
            by_base[row : row + 2, 2] = -s * q[0] - c * q[1], c * q[0] - s * q[1]
            by_group[row : row + 2, row : row + 2] = R
        by_base[2, 2] = by_group[2, 2] = 1
        end, points = compose(base, local[:3]), transform(base, places[1:])
        x = np.concatenate([end, self.x[3:], points.ravel()])
        J = np.zeros((len(x), n + len(local)))
        J[:3, :3], J[:3, n:] = by_base[:3], by_group[:3]
        J[3:n, 3:n] = np.eye(n - 3)
        J[n:, :3], J[n:, n:] = by_base[3:], by_group[3:]
        P = np.zeros((J.shape[1], J.shape[1]))
        P[:n, :n], P[n:, n:] = self.P, group.P
        return x, J @ P @ J.T


def _merged(x, P, H):
    """What is known twice stands at one place: H x = 0, observed without error."""
    try:
        after, _ = correct(Belief(x, P), -H @ x, H, np.zeros((len(H), len(H))))
    except ValueError:
        raise ValueError("a landmark is known without error in both maps: drop one") from None
    return np.array([*after.x[:2], wrap(after.x[2]), *after.x[3:]]), after.P
