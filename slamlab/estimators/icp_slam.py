"""ICP SLAM by scan-to-scan matching: Tuček's system (§4.2, listing slam.py), corrected."""

import numpy as np

from slamlab.estimators.base import Estimator, counted
from slamlab.estimators.estimate_warnings import FEW_POINTS, weak_matches
from slamlab.estimators.growable_array import GrowableArray
from slamlab.estimators.laser_odometry import LaserOdometry
from slamlab.geometry import between, compose, transform
from slamlab.layers import Points, Poses
from slamlab.scanmatching import point_to_line, point_to_point

MIN_POINTS = 3  # least number of points of a scan that can be matched
MIN_INLIERS = 0.1  # least share of inliers of the scan's points [1]
LOW_INLIERS = 0.5  # matches with less inliers are counted: the robot may have been kidnapped [1]
STANDSTILL = np.array([1e-6, 1e-6, 1e-6])  # a smaller increment is no motion [m, m, rad]
ODOMETRY_SIGMA = 0.05, 0.05, 0.2  # prior for ICP, where scans do not constrain it [m, m, rad]
MAP_SPACING = 0.02, np.radians(1)  # motion after which a scan is added to the map [m, rad]


class IcpSlam(Estimator):
    """ICP SLAM by scan matching; shows the naive pose and map for comparison.

    Without odometry, the estimator uses laser odometry and shows no naive pose or map.

    plain : bool, the thesis' ICP: point-to-point, no outlier rejection; otherwise point-to-line.
    """

    def __init__(self, plain=False):
        super().__init__()
        self.naive_pose = np.zeros(3)
        self.matched, self.unmatched, self._weak = 0, 0, 0
        self._since_match = 0  # readings with motion since the last match
        self.plain, self.laser_odometry = plain, LaserOdometry()
        self._reference_scan = None  # the points of the last good scan
        self._reference_pose = np.zeros(3)  # the corrected pose of the last good scan
        self._increment = np.zeros(3)  # odometry since then
        self._last_mapped = np.zeros(3)
        self._map, self._naive_map, self._naive_track = GrowableArray(2), GrowableArray(2), []
        self._mapped = 0  # scans

    def step(self, reading):
        """Predict by odometry, correct the pose by scan matching, and extend the map."""
        reading = self.usable(reading)
        self.naive_pose = compose(self.naive_pose, reading.odometry)
        self._naive_track.append(self.naive_pose)
        self._increment = compose(self._increment, reading.odometry)
        self.pose = compose(self._reference_pose, self._increment)
        self._since_match += not stands_still(reading.odometry)
        points = np.empty((0, 2)) if reading.scan is None else reading.scan.points()
        if len(points) >= MIN_POINTS:
            self._register(points)
        elif reading.scan is not None:
            # the pose is predicted; the last good scan remains the reference
            self.skipped += 1
        self.record(reading.time)
        self.status = self.status_line(
            f"{counted(self._mapped, 'scan')} mapped, {self.unmatched} unmatched"
        )

    @property
    def warnings(self):
        return weak_matches(self._weak, self.matched, self.unmatched, self._since_match)

    def layers(self):
        layers = [
            Points("naive", self._naive_map.rows),
            Points("corrected", self._map.rows),
            Poses("naive", np.array(self._naive_track).reshape(-1, 3)),
            Poses("corrected", self.trajectory().poses),
        ]
        return self.shown(layers)

    def _register(self, points):
        if self.without_odometry:
            self._count_laser_odometry(points)
        elif self._reference_scan is not None:
            if stands_still(self._increment):
                return
            match = self._scan_to_scan(points)
            if match.inlier_ratio >= MIN_INLIERS:  # also if not converged: better than odometry
                self.pose = compose(self._reference_pose, match.pose)
                self.matched += 1
                self._since_match = 0
                self._weak += match.inlier_ratio * len(points) < FEW_POINTS
                if match.inlier_ratio < LOW_INLIERS:
                    self.counts["matches with few inliers"] += 1
            else:
                self.unmatched += 1
        self._reference_pose, self._increment, self._reference_scan = self.pose, np.zeros(3), points
        x, y, turn = between(self._last_mapped, self.pose)
        if self._mapped == 0 or np.hypot(x, y) > MAP_SPACING[0] or abs(turn) > MAP_SPACING[1]:
            self._map.append(transform(self.pose, points))
            self._naive_map.append(transform(self.naive_pose, points))
            self._last_mapped, self._mapped = self.pose, self._mapped + 1

    def _count_laser_odometry(self, points):
        before, self.matched = self.matched, self.laser_odometry.matched
        self.unmatched = self.laser_odometry.unmatched
        if self.matched > before:
            self._since_match = 0
            self._weak += len(points) < FEW_POINTS

    def _scan_to_scan(self, points):
        if self.plain:
            return point_to_point(points, self._reference_scan, self._increment)
        return point_to_line(
            points, self._reference_scan, self._increment, prior_sigmas=ODOMETRY_SIGMA
        )


def stands_still(motion):
    return bool((np.abs(motion) < STANDSTILL).all())
