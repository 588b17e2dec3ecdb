"""Loop closure (loop closing): candidates near a new keyframe, their verification, robust edges.

Loop-closure candidates are old keyframes near a new one; to verify one, the new scan is matched
with the submap round the old keyframe. A match of enough overlap, without contradictions and inside
the graph's χ² gate (against perceptual aliasing) becomes a robust edge. A few candidates are
verified between readings.
"""

from collections import deque

import numpy as np

from slamlab.geometry import between, wrap
from slamlab.posegraph import edge_error
from slamlab.scanmatching import match
from slamlab.scanmatching.common_error import CommonError
from slamlab.scanmatching.match_quality import assess
from slamlab.scanmatching.registration import find_correspondences
from slamlab.scanmatching.submap import build_submap

APART = 20  # least keyframes between the two of a loop-closure candidate
NEAR = 0.6  # largest distance of a candidate, a share of the scan's reach [1]
SUBMAP_NEIGHBOURS = 4  # keyframes to either side of an old one in its submap
MAX_CANDIDATES = 3  # candidates of a new keyframe, at most
CANDIDATES_PER_READING = 2  # candidates verified between two readings
MIN_OVERLAP, MIN_AGREEMENT = 0.5, 0.85  # of a scan with the old submap, and with the old scan [1]
SURPRISE = 60.0  # χ² gate: squared Mahalanobis distance of a loop edge to the graph's belief
NEGLIGIBLE_SHIFT = 0.02  # residual that needs no gate: shares of the reach, and rad
OPTIMISE_CHI2 = 100.0  # χ² of a loop edge from which the graph is optimised at once
OPTIMISE_LOOPS = 10  # loop edges after which the graph is optimised in any case
# error of a pose, as a multiple of what the residuals of walls have in common: the rest a rigid
# motion took away. On Intel it makes the weights that were found best, in clean simulation nothing
COMMON_ERROR = 1.6
MAX_ITERATIONS = 10  # of the pose graph's optimiser
# squared step in standard deviations that ends it: a tenth of one is lost in what comes next
STEP_TOLERANCE = 0.01


class LoopClosure:
    """Loop-closure candidates of a pose graph, and their verification.

    Parameters
    ----------
    graph : PoseGraph
    keyframes : list of Keyframe, one a node of the graph
    counts : Counter, to which closures and rejections are added
    """

    def __init__(self, graph, keyframes, counts):
        self.graph, self.keyframes, self.counts = graph, keyframes, counts
        self._candidates, self._pending, self._max_chi2 = deque(), 0, 0.0
        self.common_error = CommonError()
        self.connected = {0}  # tracks with a loop edge to another

    def propose_candidates(self, i):
        """Queue old keyframes near keyframe i as candidates, the nearest of each row of them."""
        poses, own = self.graph.poses, self.keyframes[i]
        before = np.arange(i)
        old = (self._tracks(i) != own.track) | (before < i - APART)
        away = np.hypot(*(poses[:i, :2] - poses[i, :2]).T)
        near = np.flatnonzero(old & (away < NEAR * own.surface.reach))
        rows = np.split(near, np.flatnonzero(np.diff(near) > 1) + 1) if len(near) else []
        nearest = sorted((row[np.argmin(away[row])] for row in rows), key=lambda j: away[j])
        self._candidates.extend((int(j), i) for j in nearest[:MAX_CANDIDATES])

    def _tracks(self, i):
        return np.array([keyframe.track for keyframe in self.keyframes[:i]], dtype=int)

    def process_candidates(self):
        """Verify a few candidates; optimise the graph where a loop edge disagrees with it."""
        for _ in range(min(CANDIDATES_PER_READING, len(self._candidates))):
            self._verify(*self._candidates.popleft())
        if self._max_chi2 > OPTIMISE_CHI2 or self._pending >= OPTIMISE_LOOPS:
            self.optimise()

    def optimise(self):
        """Optimise the pose graph, if loops were closed since it last was."""
        if self._pending:
            self.graph.optimise(MAX_ITERATIONS, tolerance=STEP_TOLERANCE)
            self._pending, self._max_chi2 = 0, 0.0

    def _verify(self, j, i):
        """Verify the candidate (j, i) by scan-to-map matching; add a robust edge if it passes."""
        scan, poses = self.keyframes[i].surface, self.graph.poses
        matched = match(scan, submap_around(self.keyframes, poses, j), between(poses[j], poses[i]))
        if not is_verified(matched, scan, self.keyframes[j].surface):
            self.counts["loop candidates rejected"] += 1
            return
        matched.add_residuals(self.common_error)
        information = match_information(matched, self.common_error.sigma)
        e = edge_error.error(*poses[[j, i]], matched.pose)
        # the gate costs the graph's covariances: not asked where the edge would move nothing
        near = np.hypot(*e[:2]) < NEGLIGIBLE_SHIFT * scan.reach
        negligible = near and abs(e[2]) < NEGLIGIBLE_SHIFT
        d2 = self.graph.squared_mahalanobis
        if not negligible and d2(j, i, matched.pose, information) > SURPRISE:
            self.counts["loops too surprising"] += 1
            return
        self.graph.add_edge(j, i, matched.pose, information, robust=True)
        self.counts["loops closed"] += 1
        self.connected.update((self.keyframes[i].track, self.keyframes[j].track))
        self._pending += 1
        self._max_chi2 = max(self._max_chi2, e @ information @ e)


def submap_around(keyframes, poses, j):
    """The submap round an old keyframe j: its neighbours merged, in its frame (Surface)."""
    around = range(max(0, j - SUBMAP_NEIGHBOURS), min(len(keyframes), j + SUBMAP_NEIGHBOURS + 1))
    around = [k for k in around if keyframes[k].track == keyframes[j].track]
    around.sort(key=lambda k: abs(k - j))
    return build_submap([keyframes[k].surface for k in around], between(poses[j], poses[around]))


def is_verified(matched, scan, old, overlap=MIN_OVERLAP, agreement=MIN_AGREEMENT):
    """Verification: a match overlaps enough, is degenerate in no direction, and does not contradict
    the old scan itself."""
    if not matched.good or matched.fit.overlap < overlap or matched.observability.degenerate.any():
        return False
    pairs = find_correspondences(scan, old, tuple(matched.pose))
    return assess(scan, old, pairs).agreement >= agreement


def match_information(matched, common=0.0):
    """Information matrix of an edge: of a match between scans of other times.

    Parameters
    ----------
    matched : Alignment
    common : float, standard deviation of the errors that residuals show in common [m]

    Returns
    -------
    (3, 3) of the residual, as ``PoseGraph.add_edge`` takes it
    """
    covariance = matched.inflated_covariance(COMMON_ERROR * common)
    return edge_error.information(matched.pose, covariance)


def pose_difference(a, b):
    """(3,) residual a − b of two poses, the angle wrapped."""
    return np.array([a[0] - b[0], a[1] - b[1], wrap(float(a[2] - b[2]))])


map_round, believable = submap_around, is_verified  # names in the first edition


def certainty(matched, scan, old):
    """The first edition's ``match_information``; the scans were asked for their noise."""
    return match_information(matched)
