"""ICP SLAM by scan-to-scan matching, Tuček's system (§4.2, listing slam.py), errata mended.

Each scan is registered with the one before it by ICP, from the odometry increment as first guess;
the result is the motion (laser odometry). Beside the corrected pose and map stand the naive ones,
from odometry alone. There is no loop closure: a place seen again is not recognised.
"""

import numpy as np

from slamlab.estimators.base import Estimator, counted
from slamlab.estimators.growing_rows import GrowingRows
from slamlab.estimators.sufficiency import THIN, thin_matches
from slamlab.geometry import between, compose, transform
from slamlab.layers import Points, Poses
from slamlab.scanmatching import point_to_line, point_to_point

MIN_POINTS = 3  # points without which a scan cannot be matched
MIN_INLIERS = 0.1  # least share of the scan's points in the fit (inliers) [1]
LOW_INLIERS = 0.5  # share below which a match is counted: the robot may have been carried [1]
STANDSTILL = np.array([1e-6, 1e-6, 1e-6])  # an increment below this is no motion [m, m, rad]
ODOMETRY_SIGMA = 0.05, 0.05, 0.2  # prior for ICP, decides degenerate directions [m, m, rad]
MAP_SPACING = 0.02, np.radians(1)  # motion after which a scan enters the map [m, rad]


class IcpSlam(Estimator):
    """ICP SLAM by scan matching, with the naive pose and map beside the corrected ones.

    Parameters
    ----------
    plain : bool, the thesis' ICP: point-to-point, no outlier rejection; else point-to-line ICP
    """

    def __init__(self, plain=False):
        super().__init__()
        self.naive_pose = np.zeros(3)
        self.matched, self.unmatched, self._thin = 0, 0, 0
        self._since_match = 0  # readings in which the robot has moved
        self.plain = plain
        self._reference_scan = None  # the points of the last good scan
        self._reference_pose = np.zeros(3)  # the corrected pose of the last good scan
        self._increment = np.zeros(3)  # odometry since then
        self._last_mapped = None
        self._map, self._naive_map, self._naive_track = GrowingRows(2), GrowingRows(2), []
        self._mapped = 0  # scans

    def step(self, reading):
        """Process a reading: predict by odometry, correct by scan matching, extend the map.

        Parameters
        ----------
        reading : Reading
        """
        reading = self.usable(reading)
        self.naive_pose = compose(self.naive_pose, reading.odometry)
        self._increment = compose(self._increment, reading.odometry)
        self.pose = compose(self._reference_pose, self._increment)
        self._since_match += not stands_still(reading.odometry)
        points = np.empty((0, 2)) if reading.scan is None else reading.scan.points()
        if len(points) >= MIN_POINTS:
            self._register(points)
        elif reading.scan is not None:
            # the pose goes on by odometry; the last good scan stays the reference
            self.skipped += 1
        self._naive_track.append(self.naive_pose)
        self.record(reading.time)
        self.status = self.status_line(
            f"{counted(self._mapped, 'scan')} mapped, {self.unmatched} unmatched"
        )

    @property
    def warnings(self):
        """What it says where it matches on too little: list of sentences."""
        return thin_matches(self._thin, self.matched, self.unmatched, self._since_match)

    def layers(self):
        """Naive and corrected map, naive and corrected trajectory."""
        return [
            Points("naive", self._naive_map.rows),
            Points("corrected", self._map.rows),
            Poses("naive", np.array(self._naive_track).reshape(-1, 3)),
            Poses("corrected", self.trajectory().poses),
        ]

    def _register(self, points):
        """Register a good scan with the reference scan, extend the map, make it the reference."""
        if self._reference_scan is not None:
            if stands_still(self._increment):
                return
            match = self._scan_to_scan(points)
            if match.share >= MIN_INLIERS:  # even one not converged beats odometry
                self.pose = compose(self._reference_pose, match.pose)
                self.matched += 1
                self._since_match = 0
                self._thin += match.share * len(points) < THIN
                if match.share < LOW_INLIERS:
                    self.counts["matches with few inliers"] += 1
            else:
                self.unmatched += 1
        self._reference_pose, self._increment, self._reference_scan = self.pose, np.zeros(3), points
        if self._last_mapped is None or moved_enough(self._last_mapped, self.pose):
            self._map.append(transform(self.pose, points))
            self._naive_map.append(transform(self.naive_pose, points))
            self._last_mapped, self._mapped = self.pose, self._mapped + 1

    def _scan_to_scan(self, points):
        """Scan-to-scan matching by ICP: the scan's pose in the frame of the reference scan."""
        if self.plain:
            return point_to_point(points, self._reference_scan, self._increment)
        return point_to_line(points, self._reference_scan, self._increment, trust=ODOMETRY_SIGMA)


def stands_still(motion):
    """Whether a motion (increment) is the identity, which is what zero means for a transform."""
    return bool((np.abs(motion) < STANDSTILL).all())


def moved_enough(a, b):
    """Whether pose b is far enough from pose a for a scan to enter the map."""
    x, y, turn = between(a, b)
    return bool(np.hypot(x, y) > MAP_SPACING[0] or abs(turn) > MAP_SPACING[1])
