"""Laser odometry (lidar odometry): estimates the motion of a lidar from its scans alone.

It predicts the motion by constant velocity, deskews the scan by this motion, matches the scan to a
submap of keyframes, and fuses prediction and match by their information.
"""

from collections import deque
from dataclasses import replace

import numpy as np

from slamlab.deskewing import deskew_by_velocity
from slamlab.geometry import between, compose, wrap
from slamlab.models.parameters import RobotModel
from slamlab.scanmatching import match, preprocess
from slamlab.scanmatching.submap import build_submap

LASER_MODEL = RobotModel(distance_error=0.03, turn_error=0.02, turn_per_metre=0.01)
CARRIER = 0.5  # nearer returns are from the person who carries the lidar [m]
# largest width of a person, and least distance in front of the background [m]
PERSON, BEFORE = 0.6, 0.3
MIN_STATIC = 0.5  # least share of static points [1]
MIN_POINTS = 10  # a scan with fewer points is not matched
DESKEWINGS = 2  # iterations of deskewing and matching
KEYFRAME_DISTANCE, KEYFRAME_TURN = 0.1, 0.35  # to a new keyframe: share of the reach, and rad
KEYFRAME_OVERLAP = 0.7  # a smaller overlap with the submap makes a new keyframe [1]
SUBMAP_SIZE = 6  # keyframes in the submap: behind a door a single one overlaps little
SEARCH = 0.8  # range of correlative matching if the match from the prediction is poor [rad]
# gate of a match around the prediction: constant, and per time [m, m/s; rad, rad/s]
MAX_SHIFT, MAX_TURN = (0.15, 1.0), (0.3, 2.0)
# standard deviations of the prediction: constant, and by acceleration [m, m/s²; rad, rad/s²]
SHIFT_SIGMA, TURN_SIGMA = (0.01, 1.0), (0.02, 3.0)
MATCH_FACTOR = 3.0  # inflation of a match's standard deviation for correlated errors [1]
MAX_COASTED = 1.0  # longest time of constant velocity without a match [s]


class LaserOdometry:
    """Adds odometry from the scans to readings; ``matched`` and ``unmatched`` count the scans."""

    def __init__(self):
        self.matched = self.unmatched = 0
        self._target, self._pose = None, np.zeros(3)  # the submap, the pose in its frame
        self._keyframes = deque(maxlen=SUBMAP_SIZE)  # PointClouds and their poses
        self._first = None  # the first scan as measured
        self._velocity, self._coasted = np.zeros(3), 0.0  # [m/s, m/s, rad/s]; [s]

    def __call__(self, reading, period):
        """Add odometry by the deskewed scan to a reading, ``period`` [s] after the last one."""
        predicted = self._velocity * period
        reading = without_carrier_returns(reading)
        if reading.scan is None or np.count_nonzero(reading.scan.valid) < MIN_POINTS:
            self._coast(predicted, period)
            return replace(reading, odometry=predicted)
        if self._target is None:
            self._first = reading.scan  # its motion is unknown until the second scan
            scan = deskew_by_velocity(reading.scan, predicted, period)
            self._add_keyframe(preprocess(static_points(scan)))
            return replace(reading, odometry=np.zeros(3), scan=scan)
        scan, cloud, motion, found = self._matched(reading.scan, predicted, period)
        if found is None:
            self.unmatched += 1
            self._coast(predicted, period)
            self._add_keyframe(cloud, lost=True)
            return replace(reading, odometry=predicted, scan=scan)
        self.matched += 1
        self._pose, self._coasted = compose(self._pose, motion), 0.0
        if period > 0:
            self._velocity = motion / period
        self._renew_keyframe(cloud, found)
        return replace(reading, odometry=motion, scan=scan)

    def _matched(self, scan, predicted, period):
        """Return the deskewed scan, its PointCloud, the motion (3,), and the Alignment or None."""
        found, first, self._first, motion = None, self._first, None, predicted
        for _ in range(DESKEWINGS if scan.times is not None else 1):
            straight = deskew_by_velocity(scan, motion, period)
            cloud = preprocess(static_points(straight))
            if first is not None:
                self._keyframes.clear()
                begin = deskew_by_velocity(first, motion, period)
                self._add_keyframe(preprocess(static_points(begin)))
            found = self._align(cloud, compose(self._pose, motion), period)
            if found is None:
                break
            pose = _fused(compose(self._pose, predicted), found, period)
            motion = between(self._pose, pose)
        return straight, cloud, motion, found

    def _align(self, cloud, guess, period):
        """Return the Alignment if it is close enough to the initial guess, otherwise None."""
        since = period + self._coasted
        for search in (0, SEARCH, None):
            found = match(cloud, self._target, guess, search=search)
            x, y, turn = between(guess, found.pose)
            near = np.hypot(x, y) < MAX_SHIFT[0] + MAX_SHIFT[1] * since
            if found.good and near and abs(turn) < MAX_TURN[0] + MAX_TURN[1] * since:
                return found
        return None

    def _renew_keyframe(self, cloud, found):
        x, y, turn = self._pose
        far = np.hypot(x, y) > KEYFRAME_DISTANCE * cloud.reach or abs(turn) > KEYFRAME_TURN
        if far or found.fit.overlap < KEYFRAME_OVERLAP:
            self._add_keyframe(cloud)

    def _add_keyframe(self, cloud, lost=False):
        """Make the last scan a keyframe. If tracking is ``lost``, discard the old keyframes."""
        last = self._keyframes[-1][1] if self._keyframes else np.zeros(3)
        if lost:
            self._keyframes.clear()
        self._keyframes.append((cloud, compose(last, self._pose)))
        clouds, poses = zip(*reversed(self._keyframes), strict=True)
        self._target = build_submap(clouds, between(poses[0], np.array(poses)))
        self._pose = np.zeros(3)

    def _coast(self, motion, period):
        """Extrapolate the motion by constant velocity, for at most MAX_COASTED."""
        self._pose = compose(self._pose, motion)
        self._coasted += period
        if self._coasted > MAX_COASTED:
            self._velocity = np.zeros(3)


def _fused(predicted, found, period):
    """Fuse the poses (3,) of an Alignment and the prediction by their information along the
    eigenvectors of the match, because a match is weakly constrained along a corridor."""
    seen = found.observability
    scale = np.array([1, 1, seen.reach])
    change = found.pose - predicted
    change[2] = wrap(change[2])
    shift, turn = (at_once + by_time * period**2 for at_once, by_time in (SHIFT_SIGMA, TURN_SIGMA))
    sigmas = np.array([shift, shift, turn * seen.reach])
    variance = (seen.directions.T**2) @ sigmas**2
    weight = variance / (variance + MATCH_FACTOR**2 / np.maximum(seen.eigenvalues, 1e-9))
    pose = predicted + seen.directions @ (weight * (seen.directions.T @ (change * scale))) / scale
    return np.array([pose[0], pose[1], wrap(float(pose[2]))])


def without_carrier_returns(reading):
    """Return the reading without those scan points that lie on the carrier of the lidar."""
    scan = reading.scan
    if scan is None or scan.range_min >= CARRIER:
        return reading
    return replace(reading, scan=replace(scan, range_min=CARRIER))


def static_points(scan):
    """Return the points (k, 2) of a scan that are not on narrow objects (such as people) in front
    of the background; if most points are on such objects, return all points."""
    points, r = scan.points(), scan.ranges[scan.valid]
    step = np.diff(r, append=r[:1])  # to the next point, around the circle
    cuts = np.flatnonzero(np.abs(step) > BEFORE)
    if len(cuts) < 2:
        return points
    label = np.searchsorted(cuts, np.arange(len(r))) % len(cuts)
    first, last = (cuts + 1) % len(r), np.roll(cuts, -1)
    nearer = (step[cuts] < 0) & (step[last] > 0)
    narrow = np.hypot(*(points[last] - points[first]).T) < PERSON
    # segments are numbered by the cut at their end, these properties by the cut before them
    free = np.roll(nearer & narrow, 1)[label]
    return points if np.mean(~free) < MIN_STATIC else points[~free]
