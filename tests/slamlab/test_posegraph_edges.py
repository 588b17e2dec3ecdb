"""Edges of a pose graph: residual, Jacobians, information."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from slamlab.geometry import compose
from slamlab.models.symbolic import numeric
from slamlab.posegraph import edge_error, edge_jacobians, edge_symbolic
from tests.property_testing import finite_differences, poses, same_angle


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
