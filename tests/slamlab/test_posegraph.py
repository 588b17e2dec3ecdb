"""Pose graphs: Jacobians, optimisation, robust kernel, marginal covariances, landmarks."""

from copy import deepcopy

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import least_squares
from scipy.stats import chi2

from slamlab.geometry import between, compose, wrap
from slamlab.models.symbolic import numeric
from slamlab.posegraph import PoseGraph, edge_error, edge_jacobians, edge_symbolic
from slamlab.posegraph.marginal_covariances import leave_one_out
from slamlab.posegraph.robust_kernels import DCS, PHI, Cauchy, Huber, Truncated
from tests.property_testing import assert_same_pose, finite_differences, poses, same_angle

SIGMA = np.array([0.05, 0.03, 0.02])  # of a measured motion, in the frame it starts from
INFORMATION = np.diag(SIGMA**-2)  # of an edge that does not turn
SIDE = 6


def square_tour(rng, laps=2, noise=1.0, drift=1.0, robust=False):
    """A graph of a robot that goes round a square, and the true poses.

    Each pose is tied to the one before, and by a loop's closure to the one a round ago; the guesses
    are reckoned from motions with their noise.
    """
    turn = np.array([*[0.0] * (SIDE - 1), np.pi / 2])
    motions = np.column_stack([np.ones(4 * SIDE), np.zeros(4 * SIDE), np.tile(turn, 4)])
    true = [np.zeros(3)]
    for motion in np.tile(motions, (laps, 1)):
        true.append(compose(true[-1], motion))
    true = np.array(true)
    graph, guess = PoseGraph(), true[0]
    graph.add_pose(guess)
    for k in range(1, len(true)):
        motion = between(true[k - 1], true[k])
        guess = compose(guess, motion + drift * SIGMA * rng.standard_normal(3))
        graph.add_pose(guess)
        measured = motion + noise * SIGMA * rng.standard_normal(3)
        graph.add_edge(k - 1, k, measured, turned(measured))
        if k >= 4 * SIDE:
            seen = between(true[k], true[k - 4 * SIDE]) + noise * SIGMA * rng.standard_normal(3)
            graph.add_edge(k, k - 4 * SIDE, seen, turned(seen), robust=robust)
    return graph, true


def turned(measured):
    """The information of the residual of an edge so measured."""
    return edge_error.information(measured, np.diag(SIGMA**2))


def whitened(graph, free):
    """What least_squares takes: residuals of all edges over the poses but the first."""
    at = np.concatenate([graph.poses[:1], free.reshape(-1, 3)])
    i, j, measured, information, _ = map(np.array, zip(*graph.edges, strict=True))
    e = edge_error.error(at[i], at[j], measured)
    return np.einsum("mba,mb->ma", np.linalg.cholesky(information), e).ravel()


def largest_deviation(graph, a, b):
    """The largest difference between two sets of poses, in standard deviations of the graph."""
    difference = a - b
    difference[:, 2] = wrap(difference[:, 2])
    deviations = np.sqrt(np.diagonal(graph.covariances(), axis1=1, axis2=2))
    return np.abs(difference[1:] / deviations[1:]).max()


@pytest.mark.slow
@given(poses, poses, poses)
def test_error_and_jacobians_equal_their_derivation(x_i, x_j, z):
    arguments = edge_symbolic.x_i, edge_symbolic.x_j, edge_symbolic.z
    derived = numeric(edge_symbolic.error, *arguments)(x_i, x_j, z)
    coded = edge_error.error(x_i, x_j, z)
    np.testing.assert_allclose(derived[:2], coded[:2], atol=1e-9)
    assert same_angle(derived[2], coded[2])
    for name in ("J_i", "J_j"):
        derived = numeric(getattr(edge_symbolic, name), *arguments)(x_i, x_j, z)
        np.testing.assert_allclose(derived, getattr(edge_jacobians, name)(x_i, x_j, z), atol=1e-9)


@given(poses, poses, poses)
def test_jacobians_equal_finite_differences(x_i, x_j, z):
    angular = np.array([False, False, True])
    slope = finite_differences(lambda x: edge_error.error(x, x_j, z), x_i, angular)
    np.testing.assert_allclose(edge_jacobians.J_i(x_i, x_j, z), slope, atol=1e-6)
    slope = finite_differences(lambda x: edge_error.error(x_i, x, z), x_j, angular)
    np.testing.assert_allclose(edge_jacobians.J_j(x_i, x_j, z), slope, atol=1e-6)


@given(poses, st.integers(0, 10**6))
def test_an_edges_information_is_the_inverse_of_the_covariance_propagated_to_its_error(z, seed):
    P, angular = random_covariance(np.random.default_rng(seed)), np.array([False, False, True])
    # at the true motion, which is z but for small errors: its error is 0 there
    slope = finite_differences(lambda x: edge_error.error(np.zeros(3), z, x), z, angular)
    scale = np.sqrt(np.diag(P))
    propagated = slope @ P @ slope.T
    claimed = np.linalg.inv(edge_error.information(z, P))
    np.testing.assert_allclose(claimed / scale.max() ** 2, propagated / scale.max() ** 2, atol=1e-6)


@given(poses, st.integers(0, 10**6))
def test_an_edges_information_equals_its_derivation(z, seed):
    P = random_covariance(np.random.default_rng(seed))
    arguments = edge_symbolic.x_i, edge_symbolic.x_j, edge_symbolic.z
    slope = numeric(edge_symbolic.J_z, *arguments)(np.zeros(3), z, z)
    derived = np.linalg.inv(slope @ P @ slope.T)
    information = edge_error.information(z, P)
    np.testing.assert_allclose(information, derived, rtol=1e-6, atol=1e-6 * np.abs(derived).max())
    np.testing.assert_array_equal(information, information.T)


@given(poses, poses, st.integers(0, 10**6))
def test_an_edge_costs_what_the_error_of_its_measurement_costs(true, x_i, seed):
    # whatever the turn and however large the error: e = −Tᵀ n is exact
    rng = np.random.default_rng(seed)
    P, n = random_covariance(rng), rng.normal(0, [1, 1, 0.5])
    e = edge_error.error(x_i, compose(x_i, true), true + n)
    cost = n @ np.linalg.solve(P, n)
    assert e @ edge_error.information(true + n, P) @ e == pytest.approx(cost, rel=1e-6)


def random_covariance(rng):
    """A covariance of x, y and θ, no diagonal one."""
    mixed = np.eye(3) + rng.uniform(-0.6, 0.6, (3, 3)) * (1 - np.eye(3))
    return mixed @ np.diag(rng.uniform(0.1, 2, 3) ** 2) @ mixed.T


def test_many_edges_at_once_are_the_same_as_one_by_one():
    rng = np.random.default_rng(1)
    many = rng.normal(size=(3, 7, 3))
    for function in (edge_error.error, edge_jacobians.J_i, edge_jacobians.J_j):
        rows = [function(*one) for one in many.transpose(1, 0, 2)]
        np.testing.assert_allclose(function(*many), rows)
    covariances = np.array([random_covariance(rng) for _ in range(7)])
    rows = [edge_error.information(*one) for one in zip(many[2], covariances, strict=True)]
    np.testing.assert_allclose(edge_error.information(many[2], covariances), rows)


@pytest.mark.parametrize("kind", [Huber, Cauchy, DCS, Truncated])
@given(value=st.floats(0, 1e6), phi=st.floats(0.1, 100))
def test_the_weight_of_a_robust_kernel_is_the_derivative_of_its_cost(kind, value, phi):
    kernel, step = kind(phi), 1e-4 * max(1.0, value)
    slope = (kernel.cost(value + step) - kernel.cost(value)) / step
    assert kernel.weight(value + step) - 1e-6 <= slope <= kernel.weight(value) + 1e-6
    bound = {DCS: 3 * phi, Truncated: phi}.get(kind, np.inf)
    assert kernel.cost(value) <= bound


def test_the_usual_phi_keeps_99_percent_of_true_edges_whole():
    assert chi2(3).cdf(PHI) == pytest.approx(0.99, abs=1e-5)


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


@pytest.mark.parametrize("seed", range(10))
def test_true_robust_edges_are_kept_however_far_the_guesses_drifted(seed):
    graph, _ = square_tour(np.random.default_rng(seed), noise=0.5, drift=8.0, robust=True)
    trusting, _ = square_tour(np.random.default_rng(seed), noise=0.5, drift=8.0)
    optimum = graph.optimise()
    trusting.optimise()
    assert optimum.converged and optimum.weights.min() == 1
    assert largest_deviation(graph, graph.poses, trusting.poses) < 0.01


@pytest.mark.parametrize("seed", range(10))
def test_a_loop_that_drift_alone_makes_look_false_is_closed(seed):
    rng = np.random.default_rng(seed)
    graph, true = square_tour(rng, laps=1)
    del graph.edges[4 * SIDE - 1 :]
    last = between(true[-2], true[-1])
    graph.add_edge(4 * SIDE - 1, 4 * SIDE, last, INFORMATION)
    for edge in graph.edges:  # reckoned from what was measured: the drift is that of the edges
        graph.poses[edge.j] = compose(graph.poses[edge.i], edge.measured)
    seen = between(true[-1], true[0]) + 0.05 * SIGMA * rng.standard_normal(3)
    sharp = 400 * INFORMATION
    error = edge_error.error(graph.poses[-1], graph.poses[0], seen)
    assert error @ sharp @ error > 100 * PHI
    graph.add_edge(4 * SIDE, 0, seen, sharp, robust=True)
    assert graph.optimise().weights[-1] == 1
    error = edge_error.error(graph.poses[-1], graph.poses[0], seen)
    assert error @ sharp @ error < PHI


@pytest.mark.parametrize("seed", range(20))
@pytest.mark.parametrize("false", [1, 8])
def test_outlier_edges_are_rejected(seed, false):
    rng = np.random.default_rng(seed)
    graph, true = square_tour(rng, robust=True)
    without = deepcopy(graph)
    for _ in range(false):
        i = int(rng.integers(0, 4 * SIDE))
        j = int(rng.integers(i + 4, len(graph)))
        wrong = compose(between(true[i], true[j]), [*rng.choice([-2, 2], 2), 0.5])
        graph.add_edge(i, j, wrong, INFORMATION, robust=True)
    optimum, clean = graph.optimise(), without.optimise()
    assert not optimum.weights[-false:].any()
    # a true edge may be rejected, too, if that costs less
    assert optimum.chi2 < clean.chi2 + false * PHI + 1e-3
    assert graph.dropped == set(np.flatnonzero(optimum.weights == 0))


@pytest.mark.parametrize("seed", range(5))
def test_few_right_loops_far_apart_are_kept_beside_more_false_ones(seed):
    rng = np.random.default_rng(seed)
    graph, _ = square_tour(rng, laps=4, robust=True)
    loops = [edge for edge in graph.edges if edge.robust]
    graph.edges = [edge for edge in graph.edges if not edge.robust] + loops[::20]
    false = set(range(len(graph.edges), len(graph.edges) + 8))
    for _ in false:
        i = int(rng.integers(0, 3 * SIDE))
        j = int(rng.integers(i + 4, len(graph)))
        graph.add_edge(i, j, [*rng.choice([-20, 20], 2), 0.5], INFORMATION, robust=True)
    graph.optimise()
    assert graph.dropped == false


def test_leaving_an_edge_out_saves_what_its_leverage_predicts():
    graph, _ = square_tour(np.random.default_rng(3), noise=0.3)
    before = graph.optimise().chi2
    loops = [k for k, edge in enumerate(graph.edges) if edge.j < edge.i][::6]
    saved = leave_one_out(graph._problem(), graph.poses, np.array(loops))
    for k, less in zip(loops, saved, strict=True):
        without = deepcopy(graph)
        del without.edges[k]
        assert before - without.optimise().chi2 == pytest.approx(less, rel=0.02, abs=0.01)


def test_a_trusted_false_edge_bends_the_graph():
    graph, true = square_tour(np.random.default_rng(0))
    without = deepcopy(graph)
    without.optimise()
    graph.add_edge(3, 20, compose(between(true[3], true[20]), [2, 2, 0.5]), INFORMATION)
    graph.optimise()
    assert largest_deviation(without, graph.poses, without.poses) > 5


@pytest.mark.slow
def test_the_covariances_are_those_of_many_runs():
    exact, true = square_tour(np.random.default_rng(0), noise=0, drift=0)
    inverse = np.linalg.inv(exact.covariances()[1:])
    seen, runs = [], 150
    for seed in range(runs):
        graph, _ = square_tour(np.random.default_rng([7, seed]))
        graph.optimise()
        error = (graph.poses - true)[1:]
        error[:, 2] = wrap(error[:, 2])
        seen.append(np.einsum("na,nab,nb->n", error, inverse, error))
    # each pose's NEES has the mean of a χ² of 3 degrees, within what 150 runs can tell
    assert np.abs(np.mean(seen, axis=0) - 3).max() < 6 * np.sqrt(6 / runs)


def test_the_covariances_are_blocks_of_the_dense_inverse():
    graph, _ = square_tour(np.random.default_rng(5))
    graph.optimise()
    free = graph.poses[1:].ravel()
    step = 1e-6 * np.eye(free.size)
    slope = [(whitened(graph, free + d) - whitened(graph, free - d)) / 2e-6 for d in step]
    P = np.linalg.inv(np.array(slope) @ np.array(slope).T)
    for k, block in enumerate(graph.covariances()[1:]):
        np.testing.assert_allclose(
            block, P[3 * k : 3 * k + 3, 3 * k : 3 * k + 3], rtol=1e-4, atol=1e-9
        )
    assert not graph.covariances()[0].any()
    some = graph.covariances(nodes=[7, 3])
    np.testing.assert_allclose(some, graph.covariances()[[7, 3]], rtol=1e-9, atol=1e-15)

    i, j, z = 7, 30, np.array([1.0, -0.5, 0.3])
    J = np.zeros((3, len(P)))
    J[:, 3 * i - 3 : 3 * i] = edge_jacobians.J_i(graph.poses[i], graph.poses[j], z)
    J[:, 3 * j - 3 : 3 * j] = edge_jacobians.J_j(graph.poses[i], graph.poses[j], z)
    v = edge_error.error(graph.poses[i], graph.poses[j], z)
    expected = v @ np.linalg.inv(J @ P @ J.T + np.linalg.inv(INFORMATION)) @ v
    assert graph.squared_mahalanobis(i, j, z, INFORMATION) == pytest.approx(expected, rel=1e-4)


def test_the_mahalanobis_distance_accepts_what_drift_explains_and_rejects_a_false_loop():
    true_distances, wrong = [], []
    for seed in range(100):
        rng = np.random.default_rng([8, seed])
        graph, true = square_tour(rng, laps=1)
        del graph.edges[4 * SIDE :]  # the loop is not closed yet
        graph.optimise()
        seen = between(true[0], true[-1]) + SIGMA * rng.standard_normal(3)
        both = np.array([seen, compose(seen, [2.0, 2.0, 0.5])])
        a, b = graph.squared_mahalanobis([0, 0], [4 * SIDE] * 2, both, INFORMATION)
        assert a == pytest.approx(graph.squared_mahalanobis(0, 4 * SIDE, seen, INFORMATION))
        true_distances.append(a)
        wrong.append(b)
    assert np.mean(true_distances) == pytest.approx(3, abs=6 * np.sqrt(6 / 100))
    assert np.median(wrong) > 2 * chi2(3).ppf(0.99)


def test_a_lone_pose_is_its_own_optimum():
    graph = PoseGraph()
    graph.add_pose([1, 2, 3])
    optimum = graph.optimise()
    assert optimum.converged and optimum.chi2 == 0


def test_too_few_iterations_are_reported_as_not_converged():
    graph, _ = square_tour(np.random.default_rng(0))
    optimum = graph.optimise(max_iterations=1)
    assert not optimum.converged and optimum.iterations == 1


@pytest.mark.parametrize(
    ("spoil", "message"),
    [
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
    ],
)
def test_wrong_use_is_refused_in_words(spoil, message):
    graph, _ = square_tour(np.random.default_rng(0))
    with pytest.raises(ValueError, match=message):
        spoil(graph)


def test_landmarks_and_priors_have_the_covariances_of_the_dense_inverse():
    graph = PoseGraph([[0, 0, 0.3], [1, 0.2, 0.1], [2, 0.1, -0.4]])
    graph.fixed = set()
    point = graph.add_landmark([1.5, 2])
    graph.add_prior(0, [0.1, 0, 0.2], np.diag([50, 30, 90]))
    graph.add_prior(2, [2, 0], [[20, 5], [5, 40]])
    for i in (0, 1):
        graph.add_edge(i, i + 1, [1, 0.1, -0.2], np.diag([80, 60, 100]))
    for i in (0, 1, 2):
        graph.add_edge(i, point, [1, 1.5 - 0.2 * i], [[9, 1], [1, 16]])
    assert graph.optimise().converged

    def whitened(free):
        x = np.append(free, 0).reshape(4, 3)
        rows = []
        for i, j, z, information, _ in graph.edges:
            e = edge_error.error(x[i] if i >= 0 else np.zeros(3), x[j], z)
            values, vectors = np.linalg.eigh(information)
            rows.append(np.sqrt(values.clip(0)) * (vectors.T @ e))
        return np.concatenate(rows)

    free = graph.poses.ravel()[:-1]
    step = 1e-6 * np.eye(free.size)
    slope = np.array([(whitened(free + d) - whitened(free - d)) / 2e-6 for d in step])
    assert np.abs(slope @ whitened(free)).max() < 1e-3  # the optimum
    P = np.linalg.inv(slope @ slope.T)
    covariances = graph.covariances()
    for k in range(3):
        block = P[3 * k : 3 * k + 3, 3 * k : 3 * k + 3]
        np.testing.assert_allclose(covariances[k], block, rtol=1e-5, atol=1e-10)
    np.testing.assert_allclose(covariances[point][:2, :2], P[9:, 9:], rtol=1e-5, atol=1e-10)
    assert not covariances[point][2].any()


@pytest.mark.parametrize(
    ("spoil", "message"),
    [
        (lambda g: g.add_landmark([1, 2, 3]), "a landmark must be x and y"),
        (lambda g: g.add_edge(2, 0, [1, 2], np.eye(2)), "from a pose to a landmark"),
        (lambda g: g.add_edge(0, 2, [1, 2, 3], np.eye(3)), "a position must be x and y"),
        (lambda g: g.add_edge(0, 2, [1, 2], np.eye(3)), "2 rows of 2"),
        (lambda g: g.add_edge(0, 2, [1, 2], np.diag([1, 0])), "singular"),
        (lambda g: g.add_prior(5, [1, 2], np.eye(2)), "only the poses 0 to 2"),
        (lambda g: g.add_prior(0, [1, 2, 3], np.zeros((3, 3))), "singular or negative"),
        (lambda g: g.add_prior(0, [1, 2, 3], np.diag([1, 1, -1])), "singular or negative"),
        (lambda g: g.add_prior(2, [1, 2, 3], np.eye(3)), "a position must be x and y"),
    ],
)
def test_wrong_landmarks_and_priors_are_refused_in_words(spoil, message):
    graph = PoseGraph(np.zeros((2, 3)))
    graph.add_landmark([1, 2])
    with pytest.raises(ValueError, match=message):
        spoil(graph)


def ring_with_two_readings(right, false):
    """A long chain with ``right`` loops home, and ``false`` ones that agree on another place."""
    graph = PoseGraph()
    graph.add_pose(np.zeros(3))
    for k in range(40):
        graph.add_pose([0.5 * (k + 1), 0.0, 0.0])
        graph.add_edge(k, k + 1, [0.5, 0.0, 0.0], np.diag([50.0, 50.0, 400.0]))
    for k, place, side in [(k, 15.0, 0.4) for k in range(right)] + [
        (k, 16.5, -0.4) for k in range(false)
    ]:
        graph.add_edge(k, 30, [place - 0.5 * k, side, 0.0], 1e4 * np.eye(3), robust=True)
    return graph


def test_two_groups_of_loops_that_agree_equally_well_are_ambiguous_until_one_is_confirmed():
    even = ring_with_two_readings(5, 5)
    optimum = even.optimise()
    assert optimum.ambiguous
    assert len(even.dropped) == 5
    difference, distance = optimum.runner_up
    assert abs(difference) < 3 * PHI and distance > 0.1
    decided = ring_with_two_readings(12, 3)
    assert not decided.optimise().ambiguous
    assert decided.dropped == set(range(len(decided.edges) - 3, len(decided.edges)))


def test_a_loop_that_later_ones_contradict_is_let_go():
    graph = ring_with_two_readings(0, 2)
    assert graph.optimise() and not graph.dropped
    false = set(range(len(graph.edges) - 2, len(graph.edges)))
    for edge in ring_with_two_readings(8, 0).edges[-8:]:
        graph.add_edge(*edge)
    graph.optimise()
    assert graph.dropped >= false
