"""Graph SLAM: scans matched with a local map, loops closed in a pose graph, online.

The promise of Tuček's third chapter. Each scan is laid over the map of the last keyframes, from
where the odometry says; where the robot has gone on, its scan becomes a keyframe and its pose one
of the graph's. A keyframe near an old one may close a loop (:mod:`slamlab.estimators.loops`). The
past is revised: ``trajectory`` is as believed now.
"""

from dataclasses import dataclass

import numpy as np

from slamlab import gridmap
from slamlab.estimators import drift
from slamlab.estimators.base import Estimator
from slamlab.estimators.elsewhere import Elsewhere
from slamlab.estimators.icp import joined
from slamlab.estimators.loops import Loops, difference
from slamlab.geometry import between, compose, transform, wrap
from slamlab.layers import Points, Poses, Segments
from slamlab.posegraph import PoseGraph
from slamlab.readings import Scan, Trajectory
from slamlab.scanmatching import Surface, match, surface
from slamlab.scanmatching.localmap import merged

FEWEST = 10  # points without which a scan tells nothing
RECENT = 15  # keyframes in the local map
STEP, TURN = 0.12, 0.35  # a keyframe every so many reaches of the scans, and every such turn [rad]
THIN = 0.6  # overlap with the local map below which a keyframe comes early
TRACKED = 0.4, 0.65  # overlap and agreement of a match that odometry backs
STRANGE = 0.75  # agreement below which odometry may not be what brought the robot here
FAR_OFF = 16.3  # χ² of 3 degrees: beyond it a match and the odometry cannot both be right
BLUR = 0.7  # of the scans' noise: what matches have in common and no covariance of one knows


@dataclass(frozen=True)
class Keyframe:
    """A scan that stays.

    Parameters
    ----------
    surface : Surface
    scan : Scan
    piece : int, which stretch it belongs to; a new one begins where nothing fits
    """

    surface: Surface
    scan: Scan
    piece: int


class GraphSlam(Estimator):
    """SLAM by scan matching and a pose graph.

    Parameters
    ----------
    robot : RobotModel
    loops : bool, whether loops are closed

    ``graph`` and ``keyframes`` hold what it knows, ``anchors`` the keyframe that each reading hangs
    on (−1 before the first), ``counts`` what happened on the way.
    """

    def __init__(self, robot, loops=True):
        super().__init__()
        self.robot, self.naive_pose = robot, np.zeros(3)
        self.graph, self.keyframes = PoseGraph(), []
        self.loops = self.elsewhere = None
        if loops:
            self.loops = Loops(self.graph, self.keyframes, self.counts)
            self.elsewhere = Elsewhere(self.loops)
        # as seen from the last keyframe
        self._relative, self._doubt = np.zeros(3), np.zeros((3, 3))
        self._map, self._reach, self._strange = None, 0.0, False
        self.anchors, self._ways, self._naive = [], [], []

    def step(self, reading):
        """Take a reading in: predict by odometry, match, keep or not, look for loops.

        Parameters
        ----------
        reading : Reading
        """
        self._drive(reading.odometry)
        if reading.scan is not None:
            points = reading.scan.points()
            if len(points) >= FEWEST:
                self._see(surface(points), reading.scan)
            else:
                self.skipped += 1
        if self.loops is not None:
            self.loops.work()
            self.elsewhere.work()
        self.anchors.append(len(self.keyframes) - 1)
        self._ways.append(self._relative)
        self._naive.append(self.naive_pose)
        self.pose = compose(self._anchor(), self._relative)
        self.record(reading.time)
        self.status = self.told(f"{len(self.keyframes)} keyframes")

    def trajectory(self):
        """Every pose so far, as the graph has it now."""
        if not self.keyframes:
            return super().trajectory()
        if self.loops is not None:
            self.loops.settle()
        anchors, ways = np.array(self.anchors), np.array(self._ways)
        poses = compose(self.graph.poses[np.maximum(anchors, 0)], ways)
        poses[anchors < 0] = ways[anchors < 0]
        return Trajectory(np.array(self._times), poses)

    def layers(self):
        """Map and track by odometry alone and as corrected, and the loops that were closed."""
        poses, shown = self.graph.poses, self.trajectory().poses
        firsts = np.flatnonzero(np.diff(self.anchors, prepend=-1) > 0)
        naive = np.array(self._naive).reshape(-1, 3)
        clouds = [keyframe.surface.points for keyframe in self.keyframes]
        loops = np.array([(e.i, e.j) for e in self.graph.edges if e.robust], int).reshape(-1, 2)
        return [
            Points("naive", joined(map(transform, naive[firsts], clouds))),
            Points("corrected", joined(map(transform, poses, clouds))),
            Segments("loop", np.hstack([poses[loops[:, 0], :2], poses[loops[:, 1], :2]])),
            Poses("naive", naive),
            Poses("corrected", shown),
        ]

    def grid(self, resolution=0.05):
        """An occupancy grid of the keyframes as they lie now: OccupancyGrid.

        Parameters
        ----------
        resolution : float, side of a cell [m]
        """
        return gridmap.build(self.graph.poses, [k.scan for k in self.keyframes], resolution)

    def _anchor(self):
        return self.graph.poses[-1] if self.keyframes else np.zeros(3)

    def _drive(self, odometry):
        """Move by odometry, and know less."""
        odometry = np.asarray(odometry, dtype=float)
        if not np.isfinite(odometry).all():
            self.counts["odometries not finite"] += 1
            odometry = np.zeros(3)
        self.naive_pose = compose(self.naive_pose, odometry)
        self._relative, self._doubt = drift.driven(
            self._relative, self._doubt, odometry, self.robot, self._reach
        )

    def _see(self, seen, scan):
        """Match a scan; make it a keyframe where it shows enough that is new."""
        if not self.keyframes:
            self._keep(seen, scan)
            return
        found = self._matched(seen)
        if found is None:  # odometry alone ties what follows, if that was a way at all
            self.counts["not matched"] += 1
            slack = drift.slack(self._relative, seen.reach)
            self._keep(seen, scan, np.linalg.inv(self._doubt + slack), self._strange)
            return
        self._correct(found, seen)
        gone = np.hypot(*self._relative[:2]) > STEP * seen.reach
        if gone or abs(self._relative[2]) > TURN or found.fit.overlap < THIN:
            self._keep(seen, scan, np.linalg.inv(self._doubt))

    def _matched(self, seen):
        """The scan on the local map, or None where nothing that odometry allows fits."""
        allowed = np.linalg.inv(self._doubt + drift.slack(self._relative, seen.reach))
        agreements = []
        for target, search in ((self._map, 0), (self.keyframes[-1].surface, 0), (self._map, 0.8)):
            found = match(seen, target, self._relative, search=search)
            off = difference(found.pose, self._relative)
            sure = found.converged and found.fit.overlap > TRACKED[0]
            if sure and found.fit.agreement > TRACKED[1] and off @ allowed @ off < FAR_OFF:
                return found
            agreements.append(found.fit.agreement)
        self._strange = max(agreements[:2]) < STRANGE  # the searched one fits anywhere
        return None

    def _correct(self, found, seen):
        """Weigh the match and the odometry by their covariances."""
        P, C = self._doubt, found.doubt(BLUR * seen.sigma)
        K = P @ np.linalg.inv(P + C)
        x = self._relative + K @ difference(found.pose, self._relative)
        self._relative = np.array([x[0], x[1], wrap(float(x[2]))])
        self._doubt = (P - K @ P + (P - K @ P).T) / 2

    def _keep(self, seen, scan, information=None, new=False):
        """Make a scan a keyframe, tied to the last one by what was measured; new: a new piece."""
        piece = self.keyframes[-1].piece + int(new) if self.keyframes else 0
        i = self.graph.add_pose(compose(self._anchor(), self._relative))
        if i:
            self.graph.add_edge(i - 1, i, self._relative, information)
        self.keyframes.append(Keyframe(seen, scan, piece))
        self._relative, self._doubt, self._reach = np.zeros(3), np.zeros((3, 3)), seen.reach
        poses = self.graph.poses
        recent = range(i, max(-1, i - RECENT), -1)
        recent = [k for k in recent if self.keyframes[k].piece == piece]
        surfaces = [self.keyframes[k].surface for k in recent]
        self._map = merged(surfaces, between(poses[i], poses[recent]))
        if self.loops is not None:
            self.loops.propose(i)
            self.elsewhere.propose(i)
