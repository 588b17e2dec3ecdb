"""Pose graphs whose edges come from the wheels alone, as lesson 15 closes them by hand."""

import numpy as np

from slamlab.estimators.mak_slam import Q_arc
from slamlab.geometry import compose
from slamlab.posegraph import PoseGraph
from slamlab.posegraph.edge_error import information
from slamlab.posegraph.optimisation import Problem

REST = np.diag([0.01, 0.01, 0.006]) ** 2  # what wheels do that no model of theirs says [m, m, rad]


def wheels_graph(steps, robot, claim=1.0):
    """A chain of poses by odometry.

    Parameters
    ----------
    steps : (n, 3) motion from pose to pose [m, m, rad]
    robot : RobotModel, how far its wheels err
    claim : float, by how much a larger error is claimed of them [1]

    Returns
    -------
    PoseGraph of n + 1 poses
    """
    graph = PoseGraph()
    graph.add_pose(np.zeros(3))
    for z in np.asarray(steps, dtype=float):
        i = graph.add_pose(compose(graph.poses[-1], z))
        Q = claim**2 * (Q_arc(np.zeros(3), z, robot) + REST)
        graph.add_edge(i - 1, i, z, information(z, Q))
    return graph


def information_of_all(graph):
    """What all edges know of all poses together, none held: Σ JᵀΛJ, in the order of the poses.

    Parameters
    ----------
    graph : PoseGraph

    Returns
    -------
    (3n, 3n) singular
    """
    edges, n = graph.edges, len(graph)
    pairs = np.array([(edge.i, edge.j) for edge in edges])
    z, of_edges = (np.array([edge[k] for edge in edges]) for k in (2, 3))
    problem = Problem(pairs, z, of_edges, np.zeros(len(edges), bool), np.ones(n, bool))
    inside = problem.linearise(graph.poses, np.zeros((len(edges), 3)), np.ones(len(edges)))[0]
    order = problem.equations.to_poses(np.eye(3 * n)).reshape(3 * n, 3 * n)
    return order @ inside.toarray() @ order.T
