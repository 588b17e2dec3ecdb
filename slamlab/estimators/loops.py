"""Loops of a graph SLAM: who may have been here before, and whether that is so.

A new keyframe asks the old ones near it; a scan is laid over a local map of old keyframes; what
fits, contradicts nothing, and is no surprise to the graph becomes a robust edge. A few candidates
are looked at between readings.
"""

from collections import deque

import numpy as np

from slamlab.geometry import between, wrap
from slamlab.scanmatching import match
from slamlab.scanmatching.align import paired
from slamlab.scanmatching.localmap import merged
from slamlab.scanmatching.verdict import fit

APART = 20  # keyframes between two that may close a loop
NEAR = 0.6  # of the scan's reach: so near an old keyframe must be
AROUND = 4  # keyframes to either side of an old one in its local map
RUNS = 3  # stretches of old keyframes asked by a new one
EACH = 2  # candidates looked at between two readings
OVERLAP, AGREEMENT = 0.5, 0.85  # of a scan with the old map, and with the old scan alone
SURPRISE = 60.0  # χ² that a loop may have beside what the graph believes
CLOSE = 0.02  # reaches, and radians: a loop that moves the graph by less is no surprise
NEWS = 100.0  # χ² beside where the graph has it, from which it is made anew at once
SOME = 10  # loops for which it is made anew in any case
BLUR = 1.0  # of the scans' noise: what two scans of a place differ by beyond it
ROUNDS = 10


class Loops:
    """Candidates of loops and their trial.

    Parameters
    ----------
    graph : PoseGraph
    keyframes : list of Keyframe, pose by pose of the graph
    counts : Counter, to note what happened
    """

    def __init__(self, graph, keyframes, counts):
        self.graph, self.keyframes, self.counts = graph, keyframes, counts
        self._waiting, self._untold, self._news = deque(), 0, 0.0
        self.tied = {0}  # pieces that a loop ties to others

    def propose(self, i):
        """Put the old keyframes near keyframe i on the list, the nearest of each stretch."""
        poses, own = self.graph.poses, self.keyframes[i]
        before = np.arange(i)
        old = (self._pieces(i) != own.piece) | (before < i - APART)
        away = np.hypot(*(poses[:i, :2] - poses[i, :2]).T)
        near = np.flatnonzero(old & (away < NEAR * own.surface.reach))
        runs = np.split(near, np.flatnonzero(np.diff(near) > 1) + 1) if len(near) else []
        nearest = sorted((run[np.argmin(away[run])] for run in runs), key=lambda j: away[j])
        self._waiting.extend((int(j), i) for j in nearest[:RUNS])

    def _pieces(self, i):
        return np.array([keyframe.piece for keyframe in self.keyframes[:i]], dtype=int)

    def work(self):
        """Look at a few candidates; move the poses where that closed a loop that tells news."""
        for _ in range(min(EACH, len(self._waiting))):
            self._try(*self._waiting.popleft())
        if self._news > NEWS or self._untold >= SOME:
            self.settle()

    def settle(self):
        """Take in what was found since the graph was last made anew."""
        if self._untold:
            self.graph.optimise(ROUNDS)
            self._untold, self._news = 0, 0.0

    def _try(self, j, i):
        """Lay keyframe i over the map round keyframe j; keep what it tells."""
        seen, poses = self.keyframes[i].surface, self.graph.poses
        found = match(seen, map_round(self.keyframes, poses, j), between(poses[j], poses[i]))
        if not believable(found, seen, self.keyframes[j].surface):
            self.counts["loops refused"] += 1
            return
        information = certainty(found, seen, self.keyframes[j].surface)
        off = difference(found.pose, between(*poses[[j, i]]))
        # what lies where the graph has it anyway need not be asked for how far drift may reach
        plain = np.hypot(*off[:2]) < CLOSE * seen.reach and abs(off[2]) < CLOSE
        if not plain and self.graph.surprise(j, i, found.pose, information) > SURPRISE:
            self.counts["loops too surprising"] += 1
            return
        self.graph.add_edge(j, i, found.pose, information, robust=True)
        self.counts["loops closed"] += 1
        self.tied.update((self.keyframes[i].piece, self.keyframes[j].piece))
        self._untold += 1
        self._news = max(self._news, off @ information @ off)


def map_round(keyframes, poses, j):
    """The keyframes round keyframe j as one surface, seen from it."""
    around = range(max(0, j - AROUND), min(len(keyframes), j + AROUND + 1))
    around = [k for k in around if keyframes[k].piece == keyframes[j].piece]
    around.sort(key=lambda k: abs(k - j))
    return merged([keyframes[k].surface for k in around], between(poses[j], poses[around]))


def believable(found, seen, old, overlap=OVERLAP, agreement=AGREEMENT):
    """Whether a match shows the same place: enough overlaps, walls fix all, and nothing contradicts
    the old scan itself."""
    if not found.good or found.fit.overlap < overlap or not found.observability.fixed.all():
        return False
    return fit(seen, old, paired(seen, old, tuple(found.pose))).agreement >= agreement


def certainty(found, seen, old):
    """(3, 3) information of a match between scans of other times."""
    sigma = BLUR * np.hypot(seen.sigma, old.sigma)
    return np.linalg.inv(found.doubt(sigma))


def difference(a, b):
    """(3,) a − b, the turn wrapped."""
    return np.array([a[0] - b[0], a[1] - b[1], wrap(float(a[2] - b[2]))])
