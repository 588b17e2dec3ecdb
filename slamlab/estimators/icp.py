"""SLAM by scan matching, Tuček's system (§4.2, listing slam.py) with its errata mended.

Each scan is laid over those before it, starting from what the odometry says; what comes out is
the motion. Beside the corrected pose and map stand the naive ones, from odometry alone. There is no
loop closure: a place seen again is not recognised.
"""

from collections import deque

import numpy as np

from slamlab.estimators.base import Estimator
from slamlab.geometry import between, compose, transform
from slamlab.layers import Points, Poses
from slamlab.scanmatching import normals, point_to_line, point_to_point

FEWEST = 3  # points without which a scan cannot be matched
STILL = np.array([1e-6, 1e-6, 1e-6])  # a motion below this is none [m, m, rad]
SPACING = 0.02, np.radians(1)  # a scan enters the map when the robot went or turned this far


class IcpSlam(Estimator):
    """Scan matching SLAM with naive pose and map kept beside the corrected ones.

    Parameters
    ----------
    plain : bool, the thesis' ICP: point to point, every pair counts, over the last scan only
    scans : int, how many scans back a scan is matched with; 1 where plain
    """

    def __init__(self, plain=False, scans=10):
        super().__init__()
        self.naive_pose = np.zeros(3)
        self.unmatched = 0
        self.plain = plain
        self._recent = deque(maxlen=1 if plain else scans)
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
        self.status = f"{len(self._map)} scans in the map, {self.unmatched} not matched"

    def layers(self):
        """Naive and corrected map, naive and corrected track."""
        return [
            Points("naive", joined(self._naive_map)),
            Points("corrected", joined(self._map)),
            Poses("naive", np.array(self._naive_track).reshape(-1, 3)),
            Poses("corrected", self.trajectory().poses),
        ]

    def _take(self, points):
        """Match a good scan with those before it and put it into the map."""
        if self._recent and stands_still(self._since):
            return
        if self._recent:
            match = self._match(points)
            if match.converged:
                self.pose = compose(self._anchor, match.pose)
            else:
                self.unmatched += 1
        self._anchor, self._since = self.pose, np.zeros(3)
        self._recent.append((self.pose, points, None if self.plain else normals(points)))
        if self._placed is None or went(self._placed, self.pose):
            self._map.append(transform(self.pose, points))
            self._naive_map.append(transform(self.naive_pose, points))
            self._placed = self.pose

    def _match(self, points):
        """The scan's pose in the frame of the last good one."""
        if self.plain:
            return point_to_point(points, self._recent[-1][1], self._since)
        poses = [between(self._anchor, pose) for pose, _, _ in self._recent]
        target = [transform(p, q) for p, (_, q, _) in zip(poses, self._recent, strict=True)]
        turned = [
            transform([0, 0, p[2]], n) for p, (_, _, n) in zip(poses, self._recent, strict=True)
        ]
        return point_to_line(
            points, np.concatenate(target), self._since, target_normals=np.concatenate(turned)
        )


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
