"""Online graph SLAM: scan-to-map matching (front end), a pose graph of keyframes (back end), loop
closure, and relocalisation."""

from dataclasses import dataclass

import numpy as np

from slamlab import gridmap
from slamlab.estimators import odometry_drift
from slamlab.estimators.base import Estimator, counted
from slamlab.estimators.estimate_warnings import FEW_POINTS, weak_matches
from slamlab.estimators.laser_odometry import LASER_MODEL, LaserOdometry
from slamlab.estimators.loop_closure import LoopClosure, pose_difference
from slamlab.estimators.odometry_calibration import OdometryCalibration
from slamlab.estimators.relocalisation import Relocalisation
from slamlab.geometry import between, compose, transform, wrap
from slamlab.layers import Points, Poses, Segments
from slamlab.posegraph import PoseGraph, edge_error
from slamlab.readings import Scan, Trajectory
from slamlab.scanmatching import PointCloud, match, preprocess
from slamlab.scanmatching.submap import build_submap

MIN_POINTS = 10  # a scan with fewer points is skipped
SUBMAP_SIZE = 15  # keyframes in the submap
KEYFRAME_DISTANCE, KEYFRAME_TURN = 0.12, 0.35  # to a new keyframe: share of the reach, and rad
KEYFRAME_OVERLAP = 0.6  # a smaller overlap with the submap makes a new keyframe [1]
MIN_OVERLAP, MIN_AGREEMENT = 0.4, 0.65  # least values of an accepted scan-to-map match [1]
KIDNAPPED_AGREEMENT = 0.75  # with less agreement the robot may have been kidnapped [1]
ODOMETRY_GATE = 16.3  # χ² gate, 3 degrees of freedom: a match against the predicted increment
CORRELATED_NOISE = 0.7  # correlated error of all points, as a share of the scans' σ [1]


@dataclass(frozen=True)
class Keyframe:
    """Keyframe: a node of the pose graph. A new ``track`` begins when tracking has been lost."""

    cloud: PointCloud
    scan: Scan
    track: int


class GraphSlam(Estimator):
    """Graph-based SLAM: scan matching as front end, a pose graph with loop closure as back end.

    ``graph`` and ``keyframes`` form the map; ``anchors`` are the keyframes of the readings (−1
    before the first); ``calibration`` corrects odometry. Laser odometry replaces missing odometry.
    ``robot`` is a RobotModel; without ``loops`` no loop is closed and no robot is relocalised.
    """

    def __init__(self, robot, loops=True):
        super().__init__()
        self.robot, self.naive_pose, self.laser_odometry = robot, np.zeros(3), LaserOdometry()
        self.graph, self.keyframes = PoseGraph(), []
        self.loop_closure = self.relocalisation = None
        if loops:
            self.loop_closure = LoopClosure(self.graph, self.keyframes, self.counts)
            self.relocalisation = Relocalisation(self.loop_closure)
        # the increment since the last keyframe, in its frame, and its covariance
        self._increment, self._P = np.zeros(3), np.zeros((3, 3))
        self.calibration = OdometryCalibration(robot)
        self._submap, self._reach, self._kidnapped = None, 0.0, False
        self._matched, self._weak = 0, 0  # matched scans, and those with few points
        self._since_match = 0  # readings with motion since the last match
        self.anchors, self._increments, self._naive_poses = [], [], []

    def step(self, reading):
        """Predict by odometry, match the scan, add a keyframe, and close loops."""
        reading = self.usable(reading)
        self._predict(reading.odometry)
        if reading.scan is not None:
            points = reading.scan.points()
            if len(points) >= MIN_POINTS:
                self._match_scan(preprocess(points), reading.scan)
            else:
                self.skipped += 1
        if self.loop_closure is not None:
            self.loop_closure.process_candidates()
            self.relocalisation.process_candidates()
        self.anchors.append(len(self.keyframes) - 1)
        self._increments.append(self._increment)
        self._naive_poses.append(self.naive_pose)
        self.pose = compose(self._last_keyframe_pose(), self._increment)
        self.record(reading.time)
        self.status = self.status_line(counted(len(self.keyframes), "keyframe"))

    def trajectory(self):
        """Return the trajectory of the optimised pose graph."""
        if not self.keyframes:
            return super().trajectory()
        if self.loop_closure is not None:
            self.loop_closure.optimise()
        anchors, increments = np.array(self.anchors), np.array(self._increments)
        poses = compose(self.graph.poses[np.maximum(anchors, 0)], increments)
        poses[anchors < 0] = increments[anchors < 0]
        return Trajectory(np.array(self._times), poses)

    @property
    def warnings(self):
        unmatched = self.counts["scans not matched"]
        found = weak_matches(self._weak, self._matched, unmatched, self._since_match)
        if self.loop_closure is not None and self.loop_closure.ambiguous:
            found.append("the map is ambiguous: with other loops, another map is nearly as likely")
        return found

    def layers(self):
        poses, shown = self.graph.poses, self.trajectory().poses
        firsts = np.flatnonzero(np.diff(self.anchors, prepend=-1) > 0)
        naive = np.array(self._naive_poses).reshape(-1, 3)
        clouds = [keyframe.cloud.points for keyframe in self.keyframes]
        edges = (e for k, e in enumerate(self.graph.edges) if k not in self.graph.dropped)
        loops = np.array([(e.i, e.j) for e in edges if e.robust], int).reshape(-1, 2)
        layers = [
            Points("naive", _concatenated(map(transform, naive[firsts], clouds))),
            Points("corrected", _concatenated(map(transform, poses, clouds))),
            Segments("loop", np.hstack([poses[loops[:, 0], :2], poses[loops[:, 1], :2]])),
            Poses("naive", naive),
            Poses("corrected", shown),
        ]
        return self.shown(layers)

    def grid(self, resolution=0.05):
        """Build an OccupancyGrid from the keyframes; ``resolution`` is the side of a cell [m]."""
        return gridmap.build(self.graph.poses, [k.scan for k in self.keyframes], resolution)

    def _last_keyframe_pose(self):
        return self.graph.poses[-1] if self.keyframes else np.zeros(3)

    def _predict(self, odometry):
        odometry = np.asarray(odometry, dtype=float)
        self._since_match += bool(odometry.any())
        self.naive_pose = compose(self.naive_pose, odometry)
        calibrated = self.calibration.corrected(odometry)
        self.calibration.predict(odometry, self._reach)
        robot = LASER_MODEL if self.without_odometry else self.robot
        self._increment, self._P = odometry_drift.predict(
            self._increment, self._P, calibrated, robot, self._reach
        )

    def _match_scan(self, cloud, scan):
        """Run the front end: match the scan to the map and select keyframes."""
        if not self.keyframes:
            self._add_keyframe(cloud, scan)
            return
        matched = self._scan_to_map(cloud)
        if matched is None:  # an edge by odometry only; a new track if the robot may be kidnapped
            self.counts["scans not matched"] += 1
            self._P = self._P + odometry_drift.unmodelled_covariance(self._increment, cloud.reach)
            self._add_keyframe(cloud, scan, self._kidnapped)
            return
        self._matched += 1
        self._since_match = 0
        self._weak += matched.fit.overlap * len(cloud) < FEW_POINTS
        self._fuse_match(matched, cloud)
        far = np.hypot(*self._increment[:2]) > KEYFRAME_DISTANCE * cloud.reach
        turned = abs(self._increment[2]) > KEYFRAME_TURN
        if far or turned or matched.fit.overlap < KEYFRAME_OVERLAP:
            C = matched.inflated_covariance(CORRELATED_NOISE * cloud.sigma)
            self.calibration.update(matched.pose, C)
            self._add_keyframe(cloud, scan)

    def _scan_to_map(self, cloud):
        """Match the scan to the map near the prediction or, if this fails, by correlative matching.
        Return None if no match is accepted."""
        S = self._P + odometry_drift.unmodelled_covariance(self._increment, cloud.reach)
        information, agreements, last = np.linalg.inv(S), [], self.keyframes[-1].cloud
        for target, search in ((self._submap, 0), (last, 0), (self._submap, 0.8)):
            matched = match(cloud, target, self._increment, search=search)
            v = pose_difference(matched.pose, self._increment)
            usable = matched.converged and matched.fit.overlap > MIN_OVERLAP
            if (
                usable
                and matched.fit.agreement > MIN_AGREEMENT
                and v @ information @ v < ODOMETRY_GATE
            ):
                return matched
            agreements.append(matched.fit.agreement)
        # without the search, which finds some match anywhere
        self._kidnapped = max(agreements[:2]) < KIDNAPPED_AGREEMENT
        return None

    def _fuse_match(self, matched, cloud):
        """Correct the predicted motion increment by a scan match (Kalman update)."""
        P, C = self._P, matched.inflated_covariance(CORRELATED_NOISE * cloud.sigma)
        K = P @ np.linalg.inv(P + C)
        x = self._increment + K @ pose_difference(matched.pose, self._increment)
        self._increment = np.array([x[0], x[1], wrap(float(x[2]))])
        self._P = (P - K @ P + (P - K @ P).T) / 2

    def _add_keyframe(self, cloud, scan, new_track=False):
        """Add a keyframe (node) and its odometry edge; build a submap around the keyframe."""
        track = self.keyframes[-1].track + int(new_track) if self.keyframes else 0
        i = self.graph.add_pose(compose(self._last_keyframe_pose(), self._increment))
        if i:
            information = edge_error.information(self._increment, self._P)
            self.graph.add_edge(i - 1, i, self._increment, information)
        self.keyframes.append(Keyframe(cloud, scan, track))
        self._increment, self._P, self._reach = np.zeros(3), np.zeros((3, 3)), cloud.reach
        self.calibration.restart()
        poses = self.graph.poses
        recent = range(i, max(-1, i - SUBMAP_SIZE), -1)
        recent = [k for k in recent if self.keyframes[k].track == track]
        clouds = [self.keyframes[k].cloud for k in recent]
        self._submap = build_submap(clouds, between(poses[i], poses[recent]))
        if self.loop_closure is not None:
            self.loop_closure.propose_candidates(i)
            self.relocalisation.propose_candidates(i)


def _concatenated(clouds):
    return np.concatenate([np.empty((0, 2)), *clouds])
