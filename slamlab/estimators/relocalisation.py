"""Relocalisation (relocalization) of a kidnapped robot, after it was carried: global matching.

Where no scan fits the odometry (tracking lost), a new track of keyframes begins, tied by odometry
alone. As long as no loop ties it, its keyframes are matched with old ones everywhere, some between
two readings. Each match votes for a place; where enough votes agree, the track is moved there.
"""

from collections import deque

import numpy as np

from slamlab.estimators.loop_closure import is_verified, match_information, submap_around
from slamlab.geometry import between, compose, inverse
from slamlab.scanmatching import match

WEAK_INFORMATION = np.diag([1e-6, 1e-6, 1e-3])  # of an unknown motion [1/m², 1/m², 1/rad²]
FIRST_KEYFRAMES = 6  # keyframes of a track that are matched in any case
LATER_EVERY = 4  # of the later ones every so many, until the track is relocalised
MIN_SPACING = 0.5  # of the old keyframes that are matched with, a share of the reach [1]
MATCHES_PER_READING = 3  # global matches between two readings
MIN_OVERLAP, MIN_AGREEMENT = 0.6, 0.9  # stricter than for a loop, which is expected there [1]
CLUSTER_RADIUS = 0.1  # by which two votes for one place differ: shares of the reach, and rad
MIN_VOTES = 3  # keyframes that must vote for a place, two more than for any other


class Relocalisation:
    """Relocalisation of tracks of keyframes that only odometry ties to the map.

    Parameters
    ----------
    loop_closure : LoopClosure, whose graph and keyframes it works on
    """

    def __init__(self, loop_closure):
        self.loop_closure = loop_closure
        self.graph, self.keyframes = loop_closure.graph, loop_closure.keyframes
        self._candidates, self._hypotheses = deque(), []

    def propose_candidates(self, i):
        """Queue a keyframe of an unconnected track for matching with old ones everywhere."""
        track = self.keyframes[i].track
        tracks = np.array([keyframe.track for keyframe in self.keyframes[: i + 1]])
        count = np.count_nonzero(tracks == track)
        if track in self.loop_closure.connected or (
            count > FIRST_KEYFRAMES and count % LATER_EVERY
        ):
            return
        kept = []
        for j in np.flatnonzero(tracks < track):
            away = np.hypot(*(self.graph.poses[kept, :2] - self.graph.poses[j, :2]).T)
            if (away > MIN_SPACING * self.keyframes[j].surface.reach).all():
                kept.append(int(j))
        self._candidates.extend((j, i) for j in kept)

    def process_candidates(self):
        """Match a few candidates of tracks that are still unconnected; then count the votes."""
        tries = MATCHES_PER_READING
        while tries and self._candidates:
            j, i = self._candidates.popleft()
            if self.keyframes[i].track not in self.loop_closure.connected:
                self._match_globally(j, i)
                tries -= 1
        if not self._candidates and self._hypotheses:
            self._vote()

    def _match_globally(self, j, i):
        """Match keyframe i with the submap round keyframe j, by a search over all poses."""
        scan, old = self.keyframes[i].surface, self.keyframes[j].surface
        target = submap_around(self.keyframes, self.graph.poses, j)
        matched = match(scan, target, search=np.pi)
        if not is_verified(matched, scan, old, MIN_OVERLAP, MIN_AGREEMENT):
            return
        there = compose(self.graph.poses[j], matched.pose)
        # the motion that would bring the whole track there
        shift = compose(there, inverse(self.graph.poses[i]))
        common = self.loop_closure.common_error
        matched.add_residuals(common)
        edge = j, i, matched.pose, match_information(matched, common.sigma)
        self._hypotheses.append((self.keyframes[i].track, shift, there, scan.reach, edge))

    def _vote(self):
        """Cluster the newest track's hypotheses; relocalise it where one cluster clearly wins."""
        track = self._hypotheses[-1][0]
        hypotheses = [h for h in self._hypotheses if h[0] == track]
        count = sum(keyframe.track == track for keyframe in self.keyframes)
        if count < FIRST_KEYFRAMES or track in self.loop_closure.connected:
            return
        clusters = []
        for hypothesis in hypotheses:
            cluster = next((c for c in clusters if agree(c[0], hypothesis)), None)
            if cluster is None:
                clusters.append([hypothesis])
            else:
                cluster.append(hypothesis)
        clusters.sort(key=votes)
        sizes = [0, *map(votes, clusters)]
        if sizes[-1] >= MIN_VOTES and sizes[-1] > sizes[-2] + 1:
            self._hypotheses = []
            self._relocalise([h[-1] for h in clusters[-1]], clusters[-1][0][1])

    def _relocalise(self, edges, shift):
        """Move a track, add its matches as robust edges, and weaken the odometry edge."""
        track = self.keyframes[edges[0][1]].track
        own = [k for k, keyframe in enumerate(self.keyframes) if keyframe.track >= track]
        graph = self.graph
        graph.poses[own] = compose(shift, graph.poses[own])
        for n, edge in enumerate(graph.edges):
            if (edge.i, edge.j) == (own[0] - 1, own[0]):
                moved = between(*graph.poses[[edge.i, edge.j]])
                graph.edges[n] = edge._replace(measured=moved, information=WEAK_INFORMATION)
        for edge in edges:
            graph.add_edge(*edge, robust=True)
        self.loop_closure.connected.add(track)
        self.loop_closure.counts["relocalisations"] += 1
        graph.optimise()


def votes(cluster):
    """The votes of a cluster: how many keyframes gave its hypotheses."""
    return len({h[-1][1] for h in cluster})


def agree(a, b):
    """Whether two hypotheses relocalise the same track at the same place."""
    if a[0] != b[0]:
        return False
    # seen from where the track would lie: a turn far from the origin moves a lot
    x, y, turn = between(b[2], compose(compose(a[1], inverse(b[1])), b[2]))
    return np.hypot(x, y) < CLUSTER_RADIUS * b[3] and abs(turn) < CLUSTER_RADIUS
