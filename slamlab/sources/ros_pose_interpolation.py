"""Pose interpolation: poses of a moving frame, from odometry or tf, at the times of scans. It
replaces the approximate time synchronisation of two topics."""

import numpy as np

from slamlab.sources.ros_time_synchronisation import Stamps, synchronise

ROW = 9  # numbers of a row: timestamp, reception [s], position (3) [m], quaternion xyzw (4)
MIN_COS_TILT = 0.9  # least cosine of the tilt of a horizontal scan
MAX_CLIMB = 1.0  # of planar odometry, along its z axis [m]
SAME = 1e-6  # transforms with smaller differences are equal [m, 1]
MIN_GAP, GAP_FACTOR = 1.0, 5.0  # of odometry: least duration [s], in median periods [1]
MIN_JUMP, MAX_JUMPS = 0.05, 0.1  # of odometry back and forth [m, rad], and their share [1]


class PoseSeries:
    """Timestamped poses of a frame that moves in the plane; ROW describes ``rows`` (k, 9)."""

    def __init__(self, name, rows):
        self.name, self.stamps = name, Stamps(rows[:, 0], rows[:, 1])
        x, y, z, w = (rows[:, 5:] / np.linalg.norm(rows[:, 5:], axis=1)[:, None]).T
        yaw = np.arctan2(2 * (x * y + z * w), 1 - 2 * (y * y + z * z))
        self.up = 1 - 2 * (x * x + y * y)  # cosine of the tilt
        low, high = np.quantile(rows[:, 2:5], (0.05, 0.95), axis=0)  # without outliers
        self.climb = float(high[2] - low[2])
        self.extent = float(np.hypot(*(high - low)[:2]))
        self._planar = np.column_stack([rows[:, 2:4], yaw])
        self._flip = np.diag([1.0, -1.0, -1.0, 1.0]) if np.median(self.up) < 0 else np.eye(4)

    def stands_still(self):
        """Return whether several poses are all equal."""
        return len(self._planar) > 1 and bool(np.ptp(self._planar, axis=0).max() < SAME)

    def has_two_publishers(self):
        """Return whether the poses jump back and forth because two publishers disagree."""
        steps = np.diff(self._planar, axis=0)
        steps[:, 2] = np.angle(np.exp(1j * steps[:, 2]))
        back = np.zeros(max(0, len(steps) - 1), dtype=bool)
        for part in (steps[:, :2], steps[:, 2:]):  # of the position, of the heading
            lengths = np.linalg.norm(part, axis=1)
            least = np.minimum(lengths[1:], lengths[:-1])
            along = np.sum(part[1:] * part[:-1], axis=1)
            back |= (least > MIN_JUMP) & (along < -0.5 * lengths[1:] * lengths[:-1])
        return bool(np.mean([*back, False]) > MAX_JUMPS)

    def prepare(self, stamps):
        """Prepare the interpolation at ``stamps``. Return a function of a slice that returns
        T (m, 4, 4) and masks (m,) of covered and tilted poses; and a note, or ""."""
        times, own, note = synchronise(stamps, self.stamps)
        own, first = np.unique(own, return_index=True)
        planar = self._planar[first]
        columns = *planar[:, :2].T, np.unwrap(planar[:, 2])
        up = np.abs(self.up[first])
        in_gap = _gaps(own, columns)

        def at(part):
            now = times[part]
            covered = (now >= own[0]) & (now <= own[-1]) & ~in_gap(now)
            T = _homogeneous(*(np.interp(now, own, column) for column in columns)) @ self._flip
            return T, covered, np.interp(now, own, up) < MIN_COS_TILT

        return at, f"the timestamps of the scans and of {self.name} {note}" if note else ""


def _gaps(times, columns):
    """Return a function that masks times [s] in a gap during which the frame moved."""
    periods = np.diff(times)
    if not len(periods):
        return lambda now: np.zeros(len(now), dtype=bool)
    longest = max(MIN_GAP, GAP_FACTOR * float(np.median(periods)))
    moved = np.any([np.abs(np.diff(column)) > SAME for column in columns], axis=0)
    gap = (periods > longest) & moved

    def in_gap(now):
        after = np.clip(np.searchsorted(times, now, side="right"), 1, len(times) - 1)
        exactly = now == times[after - 1]
        return gap[after - 1] & ~exactly & (now < times[after])

    return in_gap


def _homogeneous(x, y, theta):
    T = np.tile(np.eye(4), (len(x), 1, 1))
    T[:, 0, 3], T[:, 1, 3] = x, y
    c, s = np.cos(theta), np.sin(theta)
    T[:, 0, 0], T[:, 0, 1], T[:, 1, 0], T[:, 1, 1] = c, -s, s, c
    return T
