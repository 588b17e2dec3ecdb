"""Marginal covariances of a pose graph, landmarks and priors among its nodes."""

import numpy as np
import pytest
from scipy.stats import chi2

from slamlab.geometry import between, compose, wrap
from slamlab.posegraph import PoseGraph, edge_error, edge_jacobians
from tests.slamlab.square_tour import INFORMATION, SIDE, SIGMA, square_tour, whitened
from tests.slamlab.support import refuses


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
    assert graph.optimise(tolerance=1e-9).converged

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


def with_a_landmark():
    graph = PoseGraph(np.zeros((2, 3)))
    graph.add_landmark([1, 2])
    return graph


test_wrong_landmarks_and_priors_are_refused_in_words = refuses(
    lambda spoil: spoil(with_a_landmark()),
    (lambda g: g.add_landmark([1, 2, 3]), "a landmark must be x and y"),
    (lambda g: g.add_edge(2, 0, [1, 2], np.eye(2)), "from a pose to a landmark"),
    (lambda g: g.add_edge(0, 2, [1, 2, 3], np.eye(3)), "a position must be x and y"),
    (lambda g: g.add_edge(0, 2, [1, 2], np.eye(3)), "2 rows of 2"),
    (lambda g: g.add_edge(0, 2, [1, 2], np.diag([1, 0])), "singular"),
    (lambda g: g.add_prior(5, [1, 2], np.eye(2)), "only the poses 0 to 2"),
    (lambda g: g.add_prior(0, [1, 2, 3], np.zeros((3, 3))), "singular or negative"),
    (lambda g: g.add_prior(0, [1, 2, 3], np.diag([1, 1, -1])), "singular or negative"),
    (lambda g: g.add_prior(2, [1, 2, 3], np.eye(3)), "a position must be x and y"),
)
