"""SLAM by scan matching, Tuček's system (§4.2, listing slam.py) with its errata mended.

Each scan is laid over the one before it, starting from what the odometry says; what comes out is
the motion. Beside the corrected pose and map stand the naive ones, from odometry alone. There is no
loop closure: a place seen again is not recognised.
"""

import numpy as np

from slamlab.estimators.base import Estimator
from slamlab.geometry import between, compose, transform
from slamlab.layers import Points, Poses
from slamlab.scanmatching import point_to_line, point_to_point

FEWEST = 3  # points without which a scan cannot be matched
AGREEING = 0.1  # share of the scan that must lie on what was seen before
HALF = 0.5  # a share below this is noted: the robot may have been carried
STILL = np.array([1e-6, 1e-6, 1e-6])  # a motion below this is none [m, m, rad]
TRUST = 0.05, 0.05, 0.2  # of odometry between scans; decides where no wall does [m, m, rad]
SPACING = 0.02, np.radians(1)  # a scan enters the map when the robot went or turned this far


class IcpSlam(Estimator):
    """Scan matching SLAM with naive pose and map kept beside the corrected ones.

    Parameters
    ----------
    plain : bool, the thesis' ICP: point to point, every pair counts
    """

    def __init__(self, plain=False):
        super().__init__()
        self.naive_pose = np.zeros(3)
        self.unmatched = 0
        self.plain = plain
        self._last = None  # the points of the last good scan
        self._anchor = np.zeros(3)  # the corrected pose of the last good scan
        self._since = np.zeros(3)  # odometry since then
        self._placed = None
        self._map, self._naive_map, self._naive_track = [], [], []

    def step(self, reading):
        """Take a reading in: predict by odometry, correct by matching, draw.

        Parameters
        ----------
        reading : Reading
        """
        self.naive_pose = compose(self.naive_pose, reading.odometry)
        self._since = compose(self._since, reading.odometry)
        self.pose = compose(self._anchor, self._since)
        points = np.empty((0, 2)) if reading.scan is None else reading.scan.points()
        if len(points) >= FEWEST:
            self._take(points)
        elif reading.scan is not None:
            # the pose goes on by odometry; the last good scan stays to be matched with
            self.skipped += 1
        self._naive_track.append(self.naive_pose)
        self.record(reading.time)
        self.status = self.told(f"{len(self._map)} scans in the map, {self.unmatched} not matched")

    def layers(self):
        """Naive and corrected map, naive and corrected track."""
        return [
            Points("naive", joined(self._naive_map)),
            Points("corrected", joined(self._map)),
            Poses("naive", np.array(self._naive_track).reshape(-1, 3)),
            Poses("corrected", self.trajectory().poses),
        ]

    def _take(self, points):
        """Match a good scan with the last one and put it into the map."""
        if self._last is not None:
            if stands_still(self._since):
                return
            match = self._match(points)
            if match.share >= AGREEING:  # one that still trembles beats odometry too
                self.pose = compose(self._anchor, match.pose)
                if match.share < HALF:
                    self.counts["matches of few pairs"] += 1
            else:
                self.unmatched += 1
        self._anchor, self._since, self._last = self.pose, np.zeros(3), points
        if self._placed is None or went(self._placed, self.pose):
            self._map.append(transform(self.pose, points))
            self._naive_map.append(transform(self.naive_pose, points))
            self._placed = self.pose

    def _match(self, points):
        """The scan's pose in the frame of the last good one."""
        if self.plain:
            return point_to_point(points, self._last, self._since)
        return point_to_line(points, self._last, self._since, trust=TRUST)


def stands_still(motion):
    """Whether a motion is the identity, which is what zero means for a transform."""
    return bool((np.abs(motion) < STILL).all())


def went(a, b):
    """Whether pose b is far enough from pose a to add something to a map."""
    x, y, turn = between(a, b)
    return bool(np.hypot(x, y) > SPACING[0] or abs(turn) > SPACING[1])


def joined(clouds):
    """Clouds as one array (n, 2), also where there are none."""
    return np.concatenate([np.empty((0, 2)), *clouds])
