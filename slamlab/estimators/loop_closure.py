"""Loop closure: proposes loop-closure candidates, verifies them by scan matching and by a χ² gate
on the pose graph (against perceptual aliasing), and adds them as robust edges."""

from collections import deque

import numpy as np

from slamlab.geometry import between, wrap
from slamlab.posegraph import edge_error
from slamlab.scanmatching import match
from slamlab.scanmatching.correlated_errors import CorrelatedError
from slamlab.scanmatching.match_quality import assess
from slamlab.scanmatching.registration import find_correspondences
from slamlab.scanmatching.submap import build_submap

APART = 20  # least number of keyframes between the two keyframes of a candidate
NEAR = 0.6  # largest distance of a candidate, as a share of the scan's reach [1]
SUBMAP_NEIGHBOURS = 4  # keyframes before and after the old keyframe in its submap
MAX_CANDIDATES = 3  # largest number of candidates of a new keyframe
CANDIDATES_PER_READING = 2  # candidates verified between two readings
MIN_OVERLAP, MIN_AGREEMENT = 0.5, 0.85  # of a scan with the old submap, and with the old scan [1]
LOOP_GATE = 60.0  # χ² gate: normalised squared distance of a loop edge from the graph
NEGLIGIBLE_RESIDUAL = 0.02  # a smaller residual needs no gate: shares of the reach, and rad
OPTIMISE_CHI2 = 100.0  # a loop edge of larger χ² starts an optimisation
OPTIMISE_LOOPS = 10  # so many loop edges start an optimisation
# pose error in multiples of the correlated residual error, part of which the registration removed;
# tuned on the Intel log, without effect in a simulation without correlated errors
CORRELATED_ERROR_FACTOR = 1.6
MAX_ITERATIONS = 10  # of the pose-graph optimisation
STEP_TOLERANCE = 0.01  # of the optimisation: squared step in standard deviations [1]


class LoopClosure:
    """Loop closure in a PoseGraph in which each node has a Keyframe."""

    def __init__(self, graph, keyframes, counts):
        self.graph, self.keyframes, self.counts = graph, keyframes, counts
        self._candidates, self._pending, self._max_chi2 = deque(), 0, 0.0
        self.correlated_error = CorrelatedError()
        self.ambiguous = False  # whether another map is nearly as likely
        self.connected = {0}  # tracks with a loop edge to another track

    def propose_candidates(self, i):
        """Propose loop-closure candidates: one old keyframe for each pass near keyframe i."""
        poses, own = self.graph.poses, self.keyframes[i]
        before = np.arange(i)
        old = (self._tracks(i) != own.track) | (before < i - APART)
        away = np.hypot(*(poses[:i, :2] - poses[i, :2]).T)
        near = np.flatnonzero(old & (away < NEAR * own.cloud.reach))
        rows = np.split(near, np.flatnonzero(np.diff(near) > 1) + 1) if len(near) else []
        nearest = sorted((row[np.argmin(away[row])] for row in rows), key=lambda j: away[j])
        self._candidates.extend((int(j), i) for j in nearest[:MAX_CANDIDATES])

    def _tracks(self, i):
        return np.array([keyframe.track for keyframe in self.keyframes[:i]], dtype=int)

    def process_candidates(self):
        """Verify a few candidates, and optimise the graph if a loop edge disagrees with it."""
        for _ in range(min(CANDIDATES_PER_READING, len(self._candidates))):
            self._verify(*self._candidates.popleft())
        if self._max_chi2 > OPTIMISE_CHI2 or self._pending >= OPTIMISE_LOOPS:
            self.optimise()

    def optimise(self):
        if self._pending:
            optimum = self.graph.optimise(MAX_ITERATIONS, tolerance=STEP_TOLERANCE)
            self.ambiguous = optimum.ambiguous
            self._pending, self._max_chi2 = 0, 0.0

    def _verify(self, j, i):
        """Verify a loop-closure candidate by matching and by the gate; if valid, add its edge."""
        scan, poses = self.keyframes[i].cloud, self.graph.poses
        matched = match(scan, submap_around(self.keyframes, poses, j), between(poses[j], poses[i]))
        if not is_verified(matched, scan, self.keyframes[j].cloud):
            self.counts["loop candidates rejected"] += 1
            return
        matched.add_residuals(self.correlated_error)
        information = match_information(matched, self.correlated_error.sigma)
        e = edge_error.error(*poses[[j, i]], matched.pose)
        # the gate needs marginal covariances, so it is skipped if the edge has hardly any effect
        near = np.hypot(*e[:2]) < NEGLIGIBLE_RESIDUAL * scan.reach
        negligible = near and abs(e[2]) < NEGLIGIBLE_RESIDUAL
        d2 = self.graph.squared_mahalanobis
        if not negligible and d2(j, i, matched.pose, information) > LOOP_GATE:
            self.counts["loops outside the gate"] += 1
            return
        self.graph.add_edge(j, i, matched.pose, information, robust=True)
        self.counts["loops closed"] += 1
        self.connected.update((self.keyframes[i].track, self.keyframes[j].track))
        self._pending += 1
        self._max_chi2 = max(self._max_chi2, e @ information @ e)


def submap_around(keyframes, poses, j):
    """Build a PointCloud of the keyframes around keyframe j, in the frame of keyframe j."""
    around = range(max(0, j - SUBMAP_NEIGHBOURS), min(len(keyframes), j + SUBMAP_NEIGHBOURS + 1))
    around = [k for k in around if keyframes[k].track == keyframes[j].track]
    around.sort(key=lambda k: abs(k - j))
    return build_submap([keyframes[k].cloud for k in around], between(poses[j], poses[around]))


def is_verified(matched, scan, old, overlap=MIN_OVERLAP, agreement=MIN_AGREEMENT):
    """Verification of a loop-closure candidate: whether the match has enough overlap, is well
    constrained in all directions, and agrees with the old scan."""
    if not matched.good or matched.fit.overlap < overlap or matched.observability.degenerate.any():
        return False
    correspondences = find_correspondences(scan, old, tuple(matched.pose))
    return assess(scan, old, correspondences).agreement >= agreement


def match_information(matched, correlated=0.0):
    """Return the information matrix (3, 3) of an edge; ``correlated``: σ of such errors [m]."""
    covariance = matched.inflated_covariance(CORRELATED_ERROR_FACTOR * correlated)
    return edge_error.information(matched.pose, covariance)


def pose_difference(a, b):
    """Return the residual a − b (3,) of two poses, angle wrapped."""
    return np.array([a[0] - b[0], a[1] - b[1], wrap(float(a[2] - b[2]))])
