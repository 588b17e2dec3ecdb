"""Graph SLAM: scan-to-map matching, a pose graph of keyframes and loop closure, all online.

The promise of Tuček's third chapter. Each scan is registered with a submap, the merged scans of the
last keyframes, from the odometry increment; where the robot has moved on, it becomes a keyframe,
its pose a node of the graph. A keyframe near an old one may close a loop (``loop_closure``); one
carried off is found again (``relocalisation``). ``trajectory`` is the past as believed now.
"""

from dataclasses import dataclass

import numpy as np

from slamlab import gridmap
from slamlab.estimators import odometry_drift
from slamlab.estimators.base import Estimator, counted
from slamlab.estimators.loop_closure import LoopClosure, pose_difference
from slamlab.estimators.odometry_calibration import OdometryCalibration
from slamlab.estimators.relocalisation import Relocalisation
from slamlab.estimators.sufficiency import THIN, thin_matches
from slamlab.geometry import between, compose, transform, wrap
from slamlab.layers import Points, Poses, Segments
from slamlab.posegraph import PoseGraph, edge_error
from slamlab.readings import Scan, Trajectory
from slamlab.scanmatching import Surface, match, surface
from slamlab.scanmatching.submap import build_submap

MIN_POINTS = 10  # points without which a scan is skipped
SUBMAP_SIZE = 15  # keyframes in the submap
KEYFRAME_DISTANCE, KEYFRAME_TURN = 0.12, 0.35  # to a new keyframe: share of the reach, and rad
KEYFRAME_OVERLAP = 0.6  # overlap with the submap below which a keyframe comes early [1]
MIN_OVERLAP, MIN_AGREEMENT = 0.4, 0.65  # of a scan-to-map match inside the odometry's gate [1]
KIDNAPPED_AGREEMENT = 0.75  # agreement below which the robot may have been carried away [1]
ODOMETRY_GATE = 16.3  # χ² of 3 degrees of freedom, of a match against the odometry's prediction
COMMON_NOISE = 0.7  # of the scans' σ: error common to all points, in no match's covariance [1]


@dataclass(frozen=True)
class Keyframe:
    """A scan that is kept, with a node of the pose graph for its pose.

    Parameters
    ----------
    surface : Surface, the scan as a point cloud with fitted lines
    scan : Scan
    track : int, the keyframes in a row that it belongs to; a new one begins where tracking is lost
    """

    surface: Surface
    scan: Scan
    track: int


class GraphSlam(Estimator):
    """Graph-based SLAM: scan matching in front, a pose graph with loop closure behind.

    Parameters
    ----------
    robot : RobotModel
    loops : bool, whether loops are closed and the robot is relocalised

    ``graph`` and ``keyframes`` are its map, ``anchors`` the keyframe of each reading (−1 before
    the first), ``counts`` the events: loops closed, loop candidates rejected, relocalisations;
    ``calibration`` holds the gains of the odometry, learned on the way.
    """

    def __init__(self, robot, loops=True):
        super().__init__()
        self.robot, self.naive_pose = robot, np.zeros(3)
        self.graph, self.keyframes = PoseGraph(), []
        self.loop_closure = self.relocalisation = None
        if loops:
            self.loop_closure = LoopClosure(self.graph, self.keyframes, self.counts)
            self.relocalisation = Relocalisation(self.loop_closure)
        # the increment since the last keyframe, in its frame, and its covariance
        self._increment, self._P = np.zeros(3), np.zeros((3, 3))
        self.calibration = OdometryCalibration(robot)
        self._submap, self._reach, self._kidnapped = None, 0.0, False
        self._matched, self._thin = 0, 0  # scans with a match, and those on few points
        self._since_match = 0  # readings in which the robot has moved
        self.anchors, self._increments, self._naive_poses = [], [], []

    def step(self, reading):
        """Process a reading: predict by odometry, match, add a keyframe, verify loop candidates.

        Parameters
        ----------
        reading : Reading
        """
        self._predict(self.usable(reading).odometry)
        if reading.scan is not None:
            points = reading.scan.points()
            if len(points) >= MIN_POINTS:
                self._match_scan(surface(points), reading.scan)
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
        """Every pose so far, after the pose graph has been optimised: Trajectory."""
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
        """What it says where it matches on too little: list of sentences."""
        unmatched = self.counts["scans not matched"]
        return thin_matches(self._thin, self._matched, unmatched, self._since_match)

    def layers(self):
        """Naive (odometry alone) and corrected map and trajectory, and the loop closures."""
        poses, shown = self.graph.poses, self.trajectory().poses
        firsts = np.flatnonzero(np.diff(self.anchors, prepend=-1) > 0)
        naive = np.array(self._naive_poses).reshape(-1, 3)
        clouds = [keyframe.surface.points for keyframe in self.keyframes]
        loops = np.array([(e.i, e.j) for e in self.graph.edges if e.robust], int).reshape(-1, 2)
        return [
            Points("naive", _concatenated(map(transform, naive[firsts], clouds))),
            Points("corrected", _concatenated(map(transform, poses, clouds))),
            Segments("loop", np.hstack([poses[loops[:, 0], :2], poses[loops[:, 1], :2]])),
            Poses("naive", naive),
            Poses("corrected", shown),
        ]

    def grid(self, resolution=0.05):
        """An occupancy grid map of the keyframes at their present poses: OccupancyGrid.

        Parameters
        ----------
        resolution : float, side of a cell [m]
        """
        return gridmap.build(self.graph.poses, [k.scan for k in self.keyframes], resolution)

    def _last_keyframe_pose(self):
        return self.graph.poses[-1] if self.keyframes else np.zeros(3)

    def _predict(self, odometry):
        """Add the odometry increment to pose and covariance (process noise)."""
        odometry = np.asarray(odometry, dtype=float)
        self._since_match += bool(odometry.any())
        self.naive_pose = compose(self.naive_pose, odometry)
        calibrated = self.calibration.corrected(odometry)
        self.calibration.predict(odometry, self._reach)
        self._increment, self._P = odometry_drift.predict(
            self._increment, self._P, calibrated, self.robot, self._reach
        )

    def _match_scan(self, cloud, scan):
        """Register a scan with the submap; make it a keyframe where it shows enough new."""
        if not self.keyframes:
            self._add_keyframe(cloud, scan)
            return
        matched = self._scan_to_map(cloud)
        if matched is None:  # an edge by odometry alone; a new track where that may be wrong
            self.counts["scans not matched"] += 1
            self._P = self._P + odometry_drift.unmodelled_covariance(self._increment, cloud.reach)
            self._add_keyframe(cloud, scan, self._kidnapped)
            return
        self._matched += 1
        self._since_match = 0
        self._thin += matched.fit.overlap * len(cloud) < THIN
        self._fuse_match(matched, cloud)
        far = np.hypot(*self._increment[:2]) > KEYFRAME_DISTANCE * cloud.reach
        turned = abs(self._increment[2]) > KEYFRAME_TURN
        if far or turned or matched.fit.overlap < KEYFRAME_OVERLAP:
            C = matched.inflated_covariance(COMMON_NOISE * cloud.sigma)
            self.calibration.update(matched.pose, C)
            self._add_keyframe(cloud, scan)

    def _scan_to_map(self, cloud):
        """Scan-to-map matching, at last by correlative search; None where none passes the gates."""
        S = self._P + odometry_drift.unmodelled_covariance(self._increment, cloud.reach)
        information, agreements, last = np.linalg.inv(S), [], self.keyframes[-1].surface
        for target, search in ((self._submap, 0), (last, 0), (self._submap, 0.8)):
            matched = match(cloud, target, self._increment, search=search)
            v = pose_difference(matched.pose, self._increment)
            sure = matched.converged and matched.fit.overlap > MIN_OVERLAP
            if (
                sure
                and matched.fit.agreement > MIN_AGREEMENT
                and v @ information @ v < ODOMETRY_GATE
            ):
                return matched
            agreements.append(matched.fit.agreement)
        self._kidnapped = max(agreements[:2]) < KIDNAPPED_AGREEMENT  # a search fits anywhere
        return None

    def _fuse_match(self, matched, cloud):
        """Kalman update of the odometry increment by the match, each with its covariance."""
        P, C = self._P, matched.inflated_covariance(COMMON_NOISE * cloud.sigma)
        K = P @ np.linalg.inv(P + C)
        x = self._increment + K @ pose_difference(matched.pose, self._increment)
        self._increment = np.array([x[0], x[1], wrap(float(x[2]))])
        self._P = (P - K @ P + (P - K @ P).T) / 2

    def _add_keyframe(self, cloud, scan, new_track=False):
        """Make a scan a keyframe with an edge to the last one, and the submap anew."""
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
        surfaces = [self.keyframes[k].surface for k in recent]
        self._submap = build_submap(surfaces, between(poses[i], poses[recent]))
        if self.loop_closure is not None:
            self.loop_closure.propose_candidates(i)
            self.relocalisation.propose_candidates(i)


def _concatenated(clouds):
    """Concatenate point clouds to one (n, 2), also where there are none."""
    return np.concatenate([np.empty((0, 2)), *clouds])
