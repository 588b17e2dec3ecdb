"""Loops true and false, for lesson 15: pairs of places judged by gates, and twin rooms.

In the twins two rooms are alike to the last chair. A graph SLAM without a gate takes one for the
other; the loops that it closes are the false ones which are put on trial here.
"""

from dataclasses import dataclass
from unittest import mock

import numpy as np

from slamlab.estimators import loop_closure
from slamlab.estimators.graph_slam import GraphSlam
from slamlab.estimators.runner import run
from slamlab.geometry import between
from slamlab.posegraph import edge_error, robust_kernel
from slamlab.scanmatching import match
from slamlab.sources.simulated_robot import simulation
from slamlab.studies.wheel_graphs import wheels_graph

APART = 0.15, 0.1  # farther from the truth than this, a loop is false [m], [rad]
ELSEWHERE = 1.0  # a loop of the twins that is farther off takes one room for the other [m]
FAR = 3.0  # times a scan's reach: how far the estimator of the twins looks for loops [1]


def true_poses(slam, source):
    """True poses of an estimator's keyframes.

    Parameters
    ----------
    slam : GraphSlam that has run
    source : what it ran on, with the truth

    Returns
    -------
    (n, 3) [m, m, rad]
    """
    return source.truth.poses[first_readings(slam)]


def first_readings(slam):
    """Number of the reading that each keyframe was made of: (n,) int."""
    return np.flatnonzero(np.diff(slam.anchors, prepend=-1) > 0)


def is_false(i, j, measured, truth):
    """Whether a loop is farther from the truth than 15 cm or 6°.

    Parameters
    ----------
    i, j : int, poses
    measured : (3,) pose j as seen from i [m, m, rad]
    truth : (n, 3) [m, m, rad]

    Returns
    -------
    bool
    """
    x, y, turn = between(between(truth[i], truth[j]), measured)
    return bool(np.hypot(x, y) > APART[0] or abs(turn) > APART[1])


def judged(slam, truth, every=6):
    """Pairs of keyframes from everywhere, matched without any guess, and what each gate says.

    Parameters
    ----------
    slam : GraphSlam that has run, without loops
    truth : (n, 3) of its keyframes [m, m, rad]
    every : int, of so many keyframes one is taken

    Returns
    -------
    (m,) bool, whether a pair is false; dict of gate to (m,) bool, whether it passes
    """
    K, graph, edges, rows = slam.keyframes, slam.graph, [], []
    for j in range(0, len(K), every):
        submap, old = loop_closure.submap_around(K, graph.poses, j), K[j].surface
        first = j + loop_closure.APART + 1
        for i in range(first + -first % every, len(K), every):
            seen = K[i].surface
            m = match(seen, submap)
            edges.append((j, i, m.pose, loop_closure.match_information(m)))
            away = np.hypot(*(graph.poses[j] - graph.poses[i])[:2])
            near = away < loop_closure.NEAR * seen.reach
            passed = near, m.good, loop_closure.is_verified(m, seen, old)
            rows.append((is_false(j, i, m.pose, truth), *passed))
    d2 = graph.squared_mahalanobis(*map(np.array, zip(*edges, strict=True)))
    false, *gates = np.column_stack([rows, d2 < loop_closure.SURPRISE]).T
    names = "near", "fits", "verified", "no surprise"
    return false, dict(zip(names, gates, strict=True))


def ends(graph, edges=None):
    """Places of a graph's loops, from pose to pose.

    Parameters
    ----------
    graph : PoseGraph
    edges : list of Edge, or None for those that are robust

    Returns
    -------
    (m, 4) [m]
    """
    edges = [edge for edge in graph.edges if edge.robust] if edges is None else edges
    pairs = np.array([(edge.i, edge.j) for edge in edges], dtype=int).reshape(-1, 2)
    return graph.poses[pairs, :2].reshape(-1, 4)


def clouds(slam):
    """Points of each keyframe's scan: list of (k, 2) [m]."""
    return [keyframe.surface.points for keyframe in slam.keyframes]


def closed_loops(slam, way):
    """Loops that an estimator closed, and which of them are false.

    Parameters
    ----------
    slam : GraphSlam that has run
    way : (r, 3) true poses of all readings [m, m, rad]

    Returns
    -------
    list of Edge, list of bool
    """
    edges, truth = [e for e in slam.graph.edges if e.robust], way[first_readings(slam)]
    return edges, [is_false(e.i, e.j, e.measured, truth) for e in edges]


def cost(graph, phi):
    """Cost of a graph's poses: χ² of trusted edges, and of robust ones what the kernel makes of it.

    Parameters
    ----------
    graph : PoseGraph
    phi : float, Φ of the robust kernel [1]

    Returns
    -------
    float [1]
    """
    total = 0.0
    for edge in graph.edges:
        e = edge_error.error(graph.poses[edge.i], graph.poses[edge.j], edge.measured)
        chi2 = e @ edge.information @ e
        total += float(robust_kernel.cost(chi2, phi)) if edge.robust else chi2
    return total


@dataclass(frozen=True)
class Twins:
    """Two laps through twin rooms, and all loops that a matcher offered.

    Parameters
    ----------
    way : (r, 3) true poses of all readings [m, m, rad]
    steps : (n − 1, 3) from keyframe to keyframe of the drive with a gate, by the wheels
        [m, m, rad]
    loops : list of Edge between those keyframes, the true ones first
    false : (m,) bool, which of them are
    with_gate, without : GraphSlam
    robot : RobotModel
    """

    way: np.ndarray
    steps: np.ndarray
    loops: list
    false: np.ndarray
    with_gate: GraphSlam
    without: GraphSlam
    robot: object

    def lies(self, edge):
        """Whether an edge between keyframes of the drive with a gate is a false loop."""
        return is_false(edge.i, edge.j, edge.measured, self.way[first_readings(self.with_gate)])

    def false_in(self, slam):
        """How many of an estimator's loops are false: int."""
        return int(np.sum(closed_loops(slam, self.way)[1]))

    def surprises(self, claim=1.0):
        """Surprise d² of each loop to what the wheels alone believe.

        Parameters
        ----------
        claim : float, by how much a larger error is claimed of the wheels [1]

        Returns
        -------
        (m,) [1]
        """
        i, j, z, information, _ = zip(*self.loops, strict=True)
        wheels = wheels_graph(self.steps, self.robot, claim)
        return wheels.squared_mahalanobis(i, j, np.array(z), np.array(information))

    def offered(self, false_loops=None):
        """Loops that are offered: all true ones, and some of the false ones, evenly taken.

        Parameters
        ----------
        false_loops : int or None, how many of them; None: all

        Returns
        -------
        (k,) int, their numbers in ``loops``
        """
        true, false = np.flatnonzero(~self.false), np.flatnonzero(self.false)
        count = len(false) if false_loops is None else false_loops
        return np.concatenate([true, false[np.linspace(0, len(false) - 1, count).astype(int)]])

    def closed(self, loops, phi):
        """The wheels' graph with some loops, all of them robust, at its optimum.

        Parameters
        ----------
        loops : (k,) int, their numbers
        phi : float, Φ of the robust kernel; infinite: every loop is trusted [1]

        Returns
        -------
        PoseGraph, Optimum
        """
        graph = wheels_graph(self.steps, self.robot)
        for k in loops:
            graph.add_edge(*self.loops[k][:4], robust=bool(np.isfinite(phi)))
        return graph, graph.optimise(phi=phi if np.isfinite(phi) else robust_kernel.PHI)

    def worst(self, poses, slam=None):
        """Largest error of the poses of keyframes.

        Parameters
        ----------
        poses : (n, 3) [m, m, rad]
        slam : GraphSlam whose keyframes they are of; None: of the one with a gate

        Returns
        -------
        float [m]
        """
        truth = self.way[first_readings(slam or self.with_gate)]
        return float(np.hypot(*between(truth, poses)[:, :2].T).max())


def twins(seed=0):
    """Drive through the twin rooms with a gate and without one, looking far for loops.

    Parameters
    ----------
    seed : int

    Returns
    -------
    Twins
    """
    source = simulation("twins", np.random.default_rng(seed))
    with mock.patch.multiple(loop_closure, NEAR=FAR):
        gated = run(source, GraphSlam(source.robot))
    with mock.patch.multiple(loop_closure, NEAR=FAR, SURPRISE=np.inf):
        open_gate = run(source, GraphSlam(source.robot)).estimator
    slam, way = gated.estimator, source.truth.poses
    readings = first_readings(slam)
    naive = gated.naive.poses[readings]
    (right, wrong), (offered, lies) = closed_loops(slam, way), closed_loops(open_gate, way)
    loops = [edge for edge, bad in zip(right, wrong, strict=True) if not bad]
    # a ruined map makes other keyframes: of its loops those are tried whose both ends are shared
    number = {int(reading): k for k, reading in enumerate(readings)}
    of_open = [number.get(int(reading)) for reading in first_readings(open_gate)]
    false = [
        edge._replace(i=of_open[edge.i], j=of_open[edge.j])
        for edge, bad in zip(offered, lies, strict=True)
        if bad and None not in (of_open[edge.i], of_open[edge.j])
    ]
    # a poor match within a room is no lie: whether there is one hangs on the last digits
    truth = way[readings]
    false = [
        edge
        for edge in false
        if np.hypot(*(between(truth[edge.i], truth[edge.j]) - edge.measured)[:2]) > ELSEWHERE
    ]
    return Twins(
        way,
        between(naive[:-1], naive[1:]),
        loops + false,
        np.arange(len(loops) + len(false)) >= len(loops),
        slam,
        open_gate,
        source.robot,
    )
