"""Pose graphs: optimisation, and wrong use."""

from copy import deepcopy

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import least_squares

from slamlab.geometry import between, compose
from slamlab.posegraph import PoseGraph
from tests.property_testing import assert_same_pose, poses
from tests.slamlab.square_tour import INFORMATION, largest_deviation, square_tour, whitened
from tests.slamlab.support import refuses


@given(st.integers(0, 10**6))
def test_exact_measurements_bring_back_the_truth_and_cost_nothing(seed):
    graph, true = square_tour(np.random.default_rng(seed), noise=0)
    optimum = graph.optimise()
    assert optimum.converged and optimum.chi2 < 1e-9
    assert_same_pose(graph.poses, true, 1e-6)


def lost(graph, rng):
    """Replace the poses of a graph but the first by guesses that have nothing to do with it."""
    graph.poses = np.vstack([graph.poses[:1], rng.uniform(-50, 50, (len(graph) - 1, 3))])


@given(st.integers(0, 10**6))
def test_without_noise_the_initial_guess_is_the_true_map(seed):
    rng = np.random.default_rng(seed)
    graph, true = square_tour(rng, laps=1, noise=0.0)
    graph.add_landmark([0.0, 0.0])
    seen = between(true[5], np.array([3.0, 2.0, 0.0]))[:2]
    graph.add_edge(5, len(graph) - 1, seen, np.eye(2))
    lost(graph, rng)
    assert graph.initialise()
    np.testing.assert_allclose(graph.poses[-1, :2], [3.0, 2.0], atol=1e-6)
    assert_same_pose(graph.poses[:-1], true, 1e-6)


@pytest.mark.parametrize("seed", range(3))
def test_from_an_initial_guess_by_the_edges_the_optimum_is_found(seed):
    rng = np.random.default_rng(seed)
    graph, _ = square_tour(rng)
    best = graph.optimise()
    optimum = graph.poses.copy()
    assert not graph.initialise()  # no guess is better
    np.testing.assert_array_equal(graph.poses, optimum)
    lost(graph, rng)
    graph.initialise()
    again = graph.optimise()
    assert again.converged and again.iterations <= 6
    assert again.chi2 == pytest.approx(best.chi2, rel=1e-6)


def test_false_loop_closures_do_not_change_an_initial_guess():
    graph, true = square_tour(np.random.default_rng(1), noise=0.0)
    for i, j in ((3, 20), (8, 30)):
        graph.add_edge(i, j, [0.5, 0.0, 2.0], INFORMATION, robust=True)
    lost(graph, np.random.default_rng(2))
    assert graph.initialise()
    np.testing.assert_allclose(graph.poses[:, :2], true[:, :2], atol=1e-6)
    loose = PoseGraph([[0, 0, 0], [1, 0, 0]])
    loose.add_edge(0, 1, [1, 0, 0], INFORMATION, robust=True)
    with pytest.raises(ValueError, match="not connected to a fixed pose"):
        loose.initialise()


@pytest.mark.parametrize("seed", range(3))
def test_the_optimum_is_that_of_scipys_dense_least_squares(seed):
    graph, _ = square_tour(np.random.default_rng(seed))
    reference = least_squares(
        lambda free: whitened(graph, free), graph.poses[1:].ravel(), method="lm", xtol=1e-12
    )
    optimum = graph.optimise()
    assert optimum.chi2 == pytest.approx(2 * reference.cost, rel=1e-9)
    found = np.concatenate([graph.poses[:1], reference.x.reshape(-1, 3)])
    assert largest_deviation(graph, graph.poses, found) < 1e-3


@pytest.mark.parametrize("seed", range(3))
def test_the_optimum_is_that_of_gtsam(seed):
    gtsam = pytest.importorskip("gtsam", reason="GTSAM, the reference, is not installed")
    graph, _ = square_tour(np.random.default_rng(seed))
    factors, guesses = gtsam.NonlinearFactorGraph(), gtsam.Values()
    factors.add(gtsam.NonlinearEqualityPose2(0, gtsam.Pose2(*graph.poses[0])))
    for k, pose in enumerate(graph.poses):
        guesses.insert(k, gtsam.Pose2(*pose))
    for edge in graph.edges:
        noise = gtsam.noiseModel.Gaussian.Information(edge.information)
        factors.add(gtsam.BetweenFactorPose2(edge.i, edge.j, gtsam.Pose2(*edge.measured), noise))
    parameters = gtsam.LevenbergMarquardtParams()
    parameters.setRelativeErrorTol(1e-12)
    best = gtsam.LevenbergMarquardtOptimizer(factors, guesses, parameters).optimize()
    reached = [best.atPose2(k) for k in range(len(graph))]
    graph.optimise()
    found = np.array([[pose.x(), pose.y(), pose.theta()] for pose in reached])
    # GTSAM may measure an error along the group's geodesic: the same to first order
    assert largest_deviation(graph, graph.poses, found) < 0.05


@given(st.integers(0, 10**6), poses)
def test_a_common_motion_of_all_guesses_moves_the_optimum_and_nothing_else(seed, moved):
    graph, _ = square_tour(np.random.default_rng(seed), robust=True)
    other = deepcopy(graph)
    other.poses = compose(moved, other.poses)
    first, second = graph.optimise(), other.optimise()
    assert second.chi2 == pytest.approx(first.chi2, rel=1e-6)
    graph.poses = compose(moved, graph.poses)
    graph.fixed = other.fixed
    assert largest_deviation(graph, graph.poses, other.poses) < 0.01


def test_the_order_and_direction_of_edges_and_poses_do_not_matter():
    rng = np.random.default_rng(3)
    graph, _ = square_tour(rng)
    order = np.concatenate([[0], 1 + rng.permutation(len(graph) - 1)])
    shuffled, place = PoseGraph(), np.argsort(order)
    for k in order:
        shuffled.add_pose(graph.poses[k])
    for k in rng.permutation(len(graph.edges)):
        edge = graph.edges[k]
        shuffled.add_edge(place[edge.i], place[edge.j], edge.measured, edge.information)
    assert shuffled.optimise().chi2 == pytest.approx(graph.optimise().chi2, rel=1e-9)
    assert largest_deviation(graph, graph.poses, shuffled.poses[place]) < 1e-3


def test_a_lone_pose_is_its_own_optimum():
    graph = PoseGraph()
    graph.add_pose([1, 2, 3])
    optimum = graph.optimise()
    assert optimum.converged and optimum.chi2 == 0


def test_too_few_iterations_are_reported_as_not_converged():
    graph, _ = square_tour(np.random.default_rng(0))
    optimum = graph.optimise(max_iterations=1)
    assert not optimum.converged and optimum.iterations == 1


test_wrong_use_is_refused_in_words = refuses(
    lambda spoil: spoil(square_tour(np.random.default_rng(0))[0]),
    (lambda g: g.add_pose([0, np.nan, 0]), "a pose must be x, y and theta, all finite"),
    (lambda g: g.add_pose([0, 0]), "a pose must be x, y and theta"),
    (lambda g: g.add_edge(0, 99, np.zeros(3), np.eye(3)), "add the poses first"),
    (lambda g: g.add_edge(1, 1, np.zeros(3), np.eye(3)), "two of the poses"),
    (lambda g: g.add_edge(0, 1, [0, 0, np.inf], np.eye(3)), "edge 0 to 1: a relative pose"),
    (lambda g: g.add_edge(0, 1, np.zeros(3), np.diag([1, 1, 0])), "singular"),
    (lambda g: g.add_edge(0, 1, np.zeros(3), -np.eye(3)), "negative"),
    (lambda g: g.add_edge(0, 1, np.zeros(3), np.triu(np.ones((3, 3)))), "symmetric"),
    (lambda g: g.add_edge(0, 1, np.zeros(3), np.eye(2)), "3 rows of 3"),
    (lambda g: (g.add_pose(np.zeros(3)), g.optimise()), "not connected .*first: pose 49"),
    (lambda g: (g.poses.__setitem__((5, 0), np.nan), g.optimise()), "pose 5 is not finite"),
    (lambda g: (g.fixed.clear(), g.optimise()), "49 of 49 poses"),
    (lambda g: setattr(g, "poses", np.zeros((2, 3))), "expected 49 poses"),
)
