"""True and false loop closures (lesson 15): loop-closure candidates that gates verify, and twin
rooms, whose loops graph SLAM without a gate confuses."""

import copy
from dataclasses import dataclass
from functools import cached_property
from unittest import mock

import numpy as np

from course.studies.odometry_graphs import draw_odometry, least_squares_problem, odometry_graph
from slamlab.estimators import loop_closure
from slamlab.estimators.graph_slam import GraphSlam
from slamlab.estimators.runner import run
from slamlab.geometry import between
from slamlab.posegraph import PoseGraph, edge_error
from slamlab.posegraph.optimisation import optimise
from slamlab.posegraph.robust_kernels import DCS
from slamlab.scanmatching import match
from slamlab.sources.simulated_robot import simulation

APART = 0.15, 0.1  # error beyond which a loop is false [m], [rad]
ELSEWHERE = 1.0  # error of a loop that confuses the twin rooms [m]
FAR = 3.0  # search distance for loops in the twin rooms, in ranges of a scan [1]


def true_poses(slam, source):
    """Return the true poses (n, 3) of a GraphSlam's keyframes."""
    return source.truth.poses[first_readings(slam)]


def first_readings(slam):
    """Return the index of each keyframe's reading: (n,) int."""
    return np.flatnonzero(np.diff(slam.anchors, prepend=-1) > 0)


def is_false(i, j, measured, truth):
    """Return whether a measured loop from pose i to j differs from the truth (n, 3) by 15 cm or
    6°."""
    x, y, turn = between(between(truth[i], truth[j]), measured)
    return bool(np.hypot(x, y) > APART[0] or abs(turn) > APART[1])


def verify_candidates(slam, truth, every=6):
    """Match loop-closure candidates, pairs of every ``every``-th keyframe, without an initial
    guess.

    Returns a mask of the false candidates (m,), and for each gate's name a mask of those that pass
    (m,). ``slam`` must not have closed any loops.
    """
    K, graph, edges, rows = slam.keyframes, slam.graph, [], []
    for j in range(0, len(K), every):
        submap, old = loop_closure.submap_around(K, graph.poses, j), K[j].cloud
        first = j + loop_closure.APART + 1
        for i in range(first + -first % every, len(K), every):
            seen = K[i].cloud
            m = match(seen, submap)
            edges.append((j, i, m.pose, loop_closure.match_information(m)))
            away = np.hypot(*(graph.poses[j] - graph.poses[i])[:2])
            near = away < loop_closure.NEAR * seen.reach
            passed = near, m.good, loop_closure.is_verified(m, seen, old)
            rows.append((is_false(j, i, m.pose, truth), *passed))
    d2 = graph.squared_mahalanobis(*map(np.array, zip(*edges, strict=True)))
    false, *gates = np.column_stack([rows, d2 < loop_closure.LOOP_GATE]).T
    names = "near", "fits", "verified", "χ² gate"
    return false, dict(zip(names, gates, strict=True))


def ends(graph, edges=None):
    """Return the end positions (m, 4) [m] of edges, by default of the robust edges."""
    edges = [edge for edge in graph.edges if edge.robust] if edges is None else edges
    pairs = np.array([(edge.i, edge.j) for edge in edges], dtype=int).reshape(-1, 2)
    return graph.poses[pairs, :2].reshape(-1, 4)


def keyframe_points(slam):
    """Return the points of each keyframe: list of (k, 2) [m]."""
    return [keyframe.cloud.points for keyframe in slam.keyframes]


def closed_loops(slam, way):
    """Return the loops that a GraphSlam closed, and a mask of the false loops."""
    edges, truth = [e for e in slam.graph.edges if e.robust], way[first_readings(slam)]
    return edges, [is_false(e.i, e.j, e.measured, truth) for e in edges]


def trust_all(graph):
    """Return a copy of a graph, optimised with the full weight of every loop."""
    trusted = copy.deepcopy(graph)
    trusted.edges = [edge._replace(robust=False) for edge in graph.edges]
    trusted.optimise()
    return trusted


def cost(graph, kernel):
    """Return χ² of a graph's non-robust edges plus the robust edges' cost with a kernel."""
    total = 0.0
    for edge in graph.edges:
        e = edge_error.error(graph.poses[edge.i], graph.poses[edge.j], edge.measured)
        chi2 = e @ edge.information @ e
        total += float(kernel.cost(chi2)) if edge.robust else chi2
    return total


def anneal(graph, phi, start, factor=4.0):
    """Optimise a graph with DCS while Φ decreases from ``start`` to ``phi``; yield Φ and the
    weights of the edges after each step (graduated non-convexity)."""
    problem, phis = least_squares_problem(graph, graph.fixed), [start]
    while phis[-1] > phi:
        phis.append(max(phi, phis[-1] / factor))
    for each, iterations in [*((each, 1) for each in phis), (phi, 100)]:
        graph.poses, optimum = optimise(problem, graph.poses, iterations, kernel=DCS(each))
        yield each, optimum.weights


@dataclass(frozen=True)
class TwinRooms:
    """Two laps through twin rooms.

    ``way`` (r, 3): true poses of all readings; ``steps`` (n − 1, 3): odometry between keyframes of
    the run with a gate; ``loops``: edges between these keyframes, the true loops first; ``false``:
    mask of the false loops.
    """

    way: np.ndarray
    steps: np.ndarray
    loops: list
    false: np.ndarray
    with_gate: GraphSlam
    without: GraphSlam
    robot: object

    def is_false_edge(self, edge):
        """Return whether an edge between keyframes of the run with a gate is false."""
        return is_false(edge.i, edge.j, edge.measured, self.way[first_readings(self.with_gate)])

    def count_false(self, slam):
        """Count the false loops of an estimator."""
        return int(np.sum(closed_loops(slam, self.way)[1]))

    def squared_mahalanobis(self, claim=1.0):
        """Return the squared Mahalanobis distance d² (m,) of each loop from odometry; ``claim``
        multiplies odometry's standard deviations."""
        i, j, z, information, _ = zip(*self.loops, strict=True)
        wheels = odometry_graph(self.steps, self.robot, claim)
        return wheels.squared_mahalanobis(i, j, np.array(z), np.array(information))

    def share_rejected_by_model(self, gate, runs=40):
        """Return the mean share of true loops beyond a gate if odometry's errors followed Q."""
        truth, rng = self.way[first_readings(self.with_gate)], np.random.default_rng(0)
        true = [edge[:4] for edge, bad in zip(self.loops, self.false, strict=True) if not bad]
        i, j, z, information = map(np.array, zip(*true, strict=True))
        shares = []
        for _ in range(runs):
            graph = odometry_graph(draw_odometry(truth, self.robot, rng), self.robot)
            shares.append(np.mean(graph.squared_mahalanobis(i, j, z, information) > gate))
        return float(np.mean(shares))

    def select_loops(self, false_loops=None):
        """Return the indices (k,) of all true loops and of evenly spaced false loops, of which the
        last one comes first."""
        true, false = np.flatnonzero(~self.false), np.flatnonzero(self.false)
        count = len(false) if false_loops is None else false_loops
        return np.concatenate([true, false[np.linspace(len(false) - 1, 0, count).astype(int)]])

    def graph(self, loops, robust=True):
        """Return the odometry graph with some loops, not optimised."""
        graph = PoseGraph(self._odometry.poses)
        loops = [self.loops[k]._replace(robust=robust) for k in loops]
        graph.edges = [*self._odometry.edges, *loops]
        return graph

    @cached_property
    def _odometry(self):
        return odometry_graph(self.steps, self.robot)

    def close_loops(self, loops, robust=True, kernel=None):
        """Optimise the odometry graph with some loops; return the graph and its Optimum."""
        graph = self.graph(loops, robust)
        return graph, graph.optimise(kernel=kernel)

    def anneal(self, loops, start, phi=11.3):
        """Optimise the odometry graph with some loops by DCS, Φ annealed from ``start``."""
        graph = self.graph(loops)
        for _ in anneal(graph, phi, start):
            pass
        return graph

    def schedule(self, start, phi=11.3):
        """Return Φ (k,), weights (k, m) of all loops, and poses (k, n, 3) after each iteration by
        DCS, Φ annealed from ``start``."""
        graph = self.graph(self.select_loops())
        steps = [(each, w, graph.poses.copy()) for each, w in anneal(graph, phi, start)]
        phis, weights, poses = map(np.array, zip(*steps, strict=True))
        return phis, weights[:, -len(self.loops) :], poses

    def largest_error(self, poses, slam=None):
        """Return the largest position error [m] of poses (n, 3) of keyframes."""
        truth = self.way[first_readings(slam or self.with_gate)]
        return float(np.hypot(*between(truth, poses)[:, :2].T).max())


def drive_twin_rooms(seed=0):
    """Run GraphSlam in the twin rooms with and without a gate, with a large search radius for
    loops."""
    source = simulation("twins", np.random.default_rng(seed))
    with mock.patch.multiple(loop_closure, NEAR=FAR):
        gated = run(source, GraphSlam(source.robot))
    with mock.patch.multiple(loop_closure, NEAR=FAR, LOOP_GATE=np.inf):
        open_gate = run(source, GraphSlam(source.robot)).estimator
    slam, way = gated.estimator, source.truth.poses
    readings = first_readings(slam)
    naive = gated.naive.poses[readings]
    (right, wrong), (offered, bad_ones) = closed_loops(slam, way), closed_loops(open_gate, way)
    loops = [edge for edge, bad in zip(right, wrong, strict=True) if not bad]
    # a distorted map has other keyframes: only loops are used whose ends both maps share
    number = {int(reading): k for k, reading in enumerate(readings)}
    of_open = [number.get(int(reading)) for reading in first_readings(open_gate)]
    false = [
        edge._replace(i=of_open[edge.i], j=of_open[edge.j])
        for edge, bad in zip(offered, bad_ones, strict=True)
        if bad and None not in (of_open[edge.i], of_open[edge.j])
    ]
    # a poor match within a room is not counted: its existence depends on rounding
    truth = way[readings]
    false = [
        edge
        for edge in false
        if np.hypot(*(between(truth[edge.i], truth[edge.j]) - edge.measured)[:2]) > ELSEWHERE
    ]
    return TwinRooms(
        way,
        between(naive[:-1], naive[1:]),
        loops + false,
        np.arange(len(loops) + len(false)) >= len(loops),
        slam,
        open_gate,
        source.robot,
    )
