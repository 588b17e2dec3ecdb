"""Pose graphs whose edges come from odometry alone (lesson 15)."""

import numpy as np
from scipy.sparse import csc_array
from scipy.sparse.linalg import splu

from slamlab.estimators.ekf_slam import Q_arc
from slamlab.files import SourceError
from slamlab.geometry import between, compose, wrap
from slamlab.posegraph import PoseGraph, g2o
from slamlab.posegraph.edge_error import information
from slamlab.posegraph.normal_equations import factorise
from slamlab.posegraph.optimisation import LeastSquaresProblem
from slamlab.sources.public_datasets import recording

UNMODELLED = np.diag([0.01, 0.01, 0.006]) ** 2  # odometry noise beyond its model [m, m, rad]


def odometry_graph(steps, robot, claim=1.0):
    """Make a chain of n + 1 poses from odometry steps (n, 3) [m, m, rad]; ``claim`` multiplies the
    standard deviations."""
    graph = PoseGraph()
    graph.add_pose(np.zeros(3))
    for z in np.asarray(steps, dtype=float):
        i = graph.add_pose(compose(graph.poses[-1], z))
        Q = claim**2 * (Q_arc(np.zeros(3), z, robot) + UNMODELLED)
        graph.add_edge(i - 1, i, z, information(z, Q))
    return graph


def least_squares_problem(graph, fixed=()):
    """Return the LeastSquaresProblem of a graph in which some poses are fixed, by default none."""
    edges, free = graph.edges, np.ones(len(graph), bool)
    free[list(fixed)] = False
    pairs = np.array([(edge.i, edge.j) for edge in edges])
    z, of_edges = (np.array([edge[k] for edge in edges]) for k in (2, 3))
    robust = np.array([edge.robust for edge in edges])
    return LeastSquaresProblem(pairs, z, of_edges, robust, free)


def gauss_newton_costs(graph, iterations):
    """Return χ² of a graph after 0, 1, … undamped Gauss-Newton steps; pose 0 is fixed."""
    problem, poses, costs = least_squares_problem(graph, fixed=[0]), graph.poses, []
    for _ in range(iterations + 1):
        e, chi2 = problem.errors(poses)
        costs.append(float(chi2.sum()))
        H, g = problem.linearise(poses, e, np.ones(len(e)))
        poses = poses - problem.equations.to_poses(factorise(H).solve(g))
        poses[:, 2] = wrap(poses[:, 2])
    return costs


def levenberg_marquardt_costs(graph, iterations):
    """Return χ² of a graph after 0, 1, … iterations of ``PoseGraph.optimise``."""
    guess, costs = graph.poses.copy(), []
    for count in range(iterations + 1):
        graph.poses = guess
        costs.append(graph.optimise(max_iterations=count).chi2)
    return costs


def fill_in(graph):
    """Count the numbers that are not zero: of Λ_x without pose 0, and of its Cholesky factor in the
    order of the poses and in a minimum-degree order."""
    information = csc_array(total_information(graph)[3:, 3:])
    options = {"diag_pivot_thresh": 0.0, "options": {"SymmetricMode": True}}
    factors = [splu(information, order, **options) for order in ("NATURAL", "MMD_AT_PLUS_A")]
    return information.nnz, *(each.L.nnz for each in factors)


def public_graphs():
    """Load the public pose graphs of CSAIL and the Intel Research Lab, by name; for a file that is
    not on this machine, print the command that fetches it."""
    graphs = {}
    for name in ("CSAIL", "intel"):
        try:
            graphs[name] = g2o.load(recording(f"{name}.g2o"))
        except SourceError as missing:
            print(missing)
    return graphs


def total_information(graph):
    """Return the information matrix of all poses, without a fixed pose: Σ JᵀΛJ, (3n, 3n),
    singular."""
    problem, n = least_squares_problem(graph), len(graph)
    e = np.zeros((len(graph.edges), 3))
    inside = problem.linearise(graph.poses, e, np.ones(len(e)))[0]
    order = problem.equations.to_poses(np.eye(3 * n)).reshape(3 * n, 3 * n)
    return order @ inside.toarray() @ order.T


def draw_odometry(poses, robot, rng):
    """Draw odometry steps (n, 3) between true poses (n + 1, 3), with errors of the model's Q."""
    steps = between(poses[:-1], poses[1:])
    drawn = []
    for step in steps:
        Q = Q_arc(np.zeros(3), step, robot) + UNMODELLED
        drawn.append(step + np.linalg.cholesky(Q) @ rng.standard_normal(3))
    return np.array(drawn)
