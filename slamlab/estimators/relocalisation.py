"""Relocalisation of a kidnapped robot (global localisation): matches the keyframes of a new track
with all old keyframes; each match votes for a pose of the track."""

from collections import deque

import numpy as np

from slamlab.estimators.loop_closure import is_verified, match_information, submap_around
from slamlab.geometry import between, compose, inverse
from slamlab.scanmatching import match

WEAK_INFORMATION = np.diag([1e-6, 1e-6, 1e-3])  # of an unknown motion [1/m², 1/m², 1/rad²]
FIRST_KEYFRAMES = 6  # first keyframes of a track, which are all matched
LATER_EVERY = 4  # of the later keyframes every so many, until the track is relocalised
MIN_SPACING = 0.5  # of the old keyframes that are used, as a share of the reach [1]
MATCHES_PER_READING = 3  # global matches between two readings
MIN_OVERLAP, MIN_AGREEMENT = 0.6, 0.9  # stricter than for a loop, which has a prior [1]
CLUSTER_RADIUS = 0.1  # largest difference of two votes for one pose: shares of the reach, and rad
MIN_VOTES = 3  # least number of keyframes that vote for a pose, two more than for any other


class Relocalisation:
    """Relocalisation of the tracks that only odometry connects to the map of a LoopClosure."""

    def __init__(self, loop_closure):
        self.loop_closure = loop_closure
        self.graph, self.keyframes = loop_closure.graph, loop_closure.keyframes
        self._candidates, self._hypotheses = deque(), []

    def propose_candidates(self, i):
        """Queue a keyframe of a track that is not yet connected to the map."""
        track = self.keyframes[i].track
        tracks = np.array([keyframe.track for keyframe in self.keyframes[: i + 1]])
        count = np.count_nonzero(tracks == track)
        left_out = count > FIRST_KEYFRAMES and count % LATER_EVERY
        if left_out or track in self.loop_closure.connected:
            return
        kept = []
        for j in np.flatnonzero(tracks < track):
            away = np.hypot(*(self.graph.poses[kept, :2] - self.graph.poses[j, :2]).T)
            if (away > MIN_SPACING * self.keyframes[j].cloud.reach).all():
                kept.append(int(j))
        self._candidates.extend((j, i) for j in kept)

    def process_candidates(self):
        """Match a few candidate pairs of keyframes, then count the votes."""
        tries = MATCHES_PER_READING
        while tries and self._candidates:
            j, i = self._candidates.popleft()
            if self.keyframes[i].track not in self.loop_closure.connected:
                self._match_globally(j, i)
                tries -= 1
        if not self._candidates and self._hypotheses:
            self._vote()

    def _match_globally(self, j, i):
        scan, old = self.keyframes[i].cloud, self.keyframes[j].cloud
        target = submap_around(self.keyframes, self.graph.poses, j)
        matched = match(scan, target, search=np.pi)
        if not is_verified(matched, scan, old, MIN_OVERLAP, MIN_AGREEMENT):
            return
        there = compose(self.graph.poses[j], matched.pose)
        # the transformation of the whole track
        shift = compose(there, inverse(self.graph.poses[i]))
        error = self.loop_closure.correlated_error
        matched.add_residuals(error)
        edge = j, i, matched.pose, match_information(matched, error.sigma)
        self._hypotheses.append((self.keyframes[i].track, shift, there, scan.reach, edge))

    def _vote(self):
        track = self._hypotheses[-1][0]
        hypotheses = [h for h in self._hypotheses if h[0] == track]
        count = sum(keyframe.track == track for keyframe in self.keyframes)
        if count < FIRST_KEYFRAMES or track in self.loop_closure.connected:
            return
        clusters = []
        for hypothesis in hypotheses:
            cluster = next((c for c in clusters if agree(c[0], hypothesis)), [])
            if not cluster:
                clusters.append(cluster)
            cluster.append(hypothesis)
        clusters.sort(key=votes)
        sizes = [0, *map(votes, clusters)]
        if sizes[-1] >= MIN_VOTES and sizes[-1] > sizes[-2] + 1:
            self._hypotheses = []
            self._relocalise([h[-1] for h in clusters[-1]], clusters[-1][0][1])

    def _relocalise(self, edges, shift):
        """Move a track, add its matches as robust edges, and weaken its odometry edge."""
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
    """Return the number of keyframes that have hypotheses in a cluster."""
    return len({h[-1][1] for h in cluster})


def agree(a, b):
    """Whether two hypotheses give the track nearly the same pose."""
    if a[0] != b[0]:
        return False
    # relative to the track's pose: a rotation about the distant origin is a large translation
    x, y, turn = between(b[2], compose(compose(a[1], inverse(b[1])), b[2]))
    return np.hypot(x, y) < CLUSTER_RADIUS * b[3] and abs(turn) < CLUSTER_RADIUS
