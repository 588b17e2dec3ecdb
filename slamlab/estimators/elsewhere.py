"""A robot that was picked up: where it was put down, found by looking at all old keyframes.

Where no scan fits what odometry says, a new piece of track begins, tied by odometry alone. As long
as no loop ties it, its keyframes are compared with old ones everywhere, some between two readings.
Only where several say the same, and few anything else, is the piece moved.
"""

from collections import deque

import numpy as np

from slamlab.estimators.loops import believable, certainty, map_round
from slamlab.geometry import between, compose, inverse
from slamlab.scanmatching import match

LOOSE = np.diag([1e-6, 1e-6, 1e-3])  # information of a motion of which nothing is known
FIRST = 6  # keyframes of a piece that are compared
AGAIN = 4  # of the later ones every so many, until they say where they are
SPARSE = 0.5  # of the reach: old keyframes nearer to each other than that show the same
EACH = 3  # comparisons between two readings
OVERLAP, AGREEMENT = 0.6, 0.9  # a place out of all must fit better than one that is expected
SAME = 0.1  # reaches, and radians, by which two answers that are one may differ
ENOUGH = 3  # keyframes that must give the same answer, two more than give any other


class Elsewhere:
    """The search for pieces of track that hang on nothing but odometry.

    Parameters
    ----------
    loops : Loops
    """

    def __init__(self, loops):
        self.loops, self.graph, self.keyframes = loops, loops.graph, loops.keyframes
        self._waiting, self._answers = deque(), []

    def propose(self, i):
        """Put a keyframe of a piece that is not tied on the list, with old ones from everywhere."""
        piece = self.keyframes[i].piece
        pieces = np.array([keyframe.piece for keyframe in self.keyframes[: i + 1]])
        asked = np.count_nonzero(pieces == piece)
        if piece in self.loops.tied or (asked > FIRST and asked % AGAIN):
            return
        kept = []
        for j in np.flatnonzero(pieces < piece):
            away = np.hypot(*(self.graph.poses[kept, :2] - self.graph.poses[j, :2]).T)
            if (away > SPARSE * self.keyframes[j].surface.reach).all():
                kept.append(int(j))
        self._waiting.extend((j, i) for j in kept)

    def work(self):
        """Make a few comparisons; what has been tied since needs none."""
        tries = EACH
        while tries and self._waiting:
            j, i = self._waiting.popleft()
            if self.keyframes[i].piece not in self.loops.tied:
                self._compare(j, i)
                tries -= 1
        if not self._waiting and self._answers:
            self._decide()

    def _compare(self, j, i):
        """Look for keyframe i round keyframe j, whatever the pose."""
        seen, old = self.keyframes[i].surface, self.keyframes[j].surface
        target = map_round(self.keyframes, self.graph.poses, j)
        found = match(seen, target, search=np.pi)
        if not believable(found, seen, old, OVERLAP, AGREEMENT):
            return
        there = compose(self.graph.poses[j], found.pose)
        # the motion that would bring the whole piece there
        shift = compose(there, inverse(self.graph.poses[i]))
        edge = j, i, found.pose, certainty(found, seen, old)
        self._answers.append((self.keyframes[i].piece, shift, there, seen.reach, edge))

    def _decide(self):
        """Move the newest piece where most of its keyframes say, if no other place is as good."""
        piece = self._answers[-1][0]
        answers = [answer for answer in self._answers if answer[0] == piece]
        asked = sum(keyframe.piece == piece for keyframe in self.keyframes)
        if asked < FIRST or piece in self.loops.tied:
            return
        groups = []
        for answer in answers:
            group = next((g for g in groups if alike(g[0], answer)), None)
            if group is None:
                groups.append([answer])
            else:
                group.append(answer)
        groups.sort(key=voters)
        sizes = [0, *map(voters, groups)]
        if sizes[-1] >= ENOUGH and sizes[-1] > sizes[-2] + 1:
            self._answers = []
            self._put_down([answer[-1] for answer in groups[-1]], groups[-1][0][1])

    def _put_down(self, edges, shift):
        """Move a piece, tie it by what was found, and let go of odometry's tie."""
        piece = self.keyframes[edges[0][1]].piece
        own = [k for k, keyframe in enumerate(self.keyframes) if keyframe.piece >= piece]
        graph = self.graph
        graph.poses[own] = compose(shift, graph.poses[own])
        for n, edge in enumerate(graph.edges):
            if (edge.i, edge.j) == (own[0] - 1, own[0]):
                moved = between(*graph.poses[[edge.i, edge.j]])
                graph.edges[n] = edge._replace(measured=moved, information=LOOSE)
        for edge in edges:
            graph.add_edge(*edge, robust=True)
        self.loops.tied.add(piece)
        self.loops.counts["times put down elsewhere"] += 1
        graph.optimise()


def voters(group):
    """How many keyframes gave the answers of a group."""
    return len({answer[-1][1] for answer in group})


def alike(a, b):
    """Whether two answers bring the same piece to the same place."""
    if a[0] != b[0]:
        return False
    # seen from where the piece would lie: a turn far from the origin moves a lot
    x, y, turn = between(b[2], compose(compose(a[1], inverse(b[1])), b[2]))
    return np.hypot(x, y) < SAME * b[3] and abs(turn) < SAME
