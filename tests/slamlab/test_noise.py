"""Noise covariances are covariances; first-order propagation is what sampling shows."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from slamlab import models
from slamlab.estimators.landmark_observations import measurement_noise
from slamlab.models import jacobians, noise
from slamlab.models.parameters import SensorModel
from tests.property_testing import odometry_controls, poses

shares = st.floats(0, 0.5)


def assert_covariance(matrix):
    np.testing.assert_array_equal(matrix, matrix.T)
    assert np.linalg.eigvalsh(matrix).min() >= -1e-12


@given(poses, odometry_controls, shares, shares, shares)
def test_Q_and_C_are_symmetric_and_positive_semidefinite(x, u, k_d, k_turn, k_s):
    C = noise.C_odometry(u, k_d, k_turn, k_s)
    assert_covariance(C)
    Q = noise.Q(jacobians.W_odometry(x, u), C)
    np.testing.assert_allclose(Q, Q.T, atol=1e-15)
    assert np.linalg.eigvalsh(Q).min() >= -1e-12


@given(st.floats(0, 20), shares, shares, shares, shares)
def test_R_is_symmetric_and_positive_semidefinite(r, k, sigma_bearing, sigma_range, curvature):
    assert_covariance(noise.R(r, k, sigma_bearing, sigma_range, curvature))


@given(st.lists(st.floats(0, 20), max_size=5), shares, shares, shares, shares)
def test_the_covariances_of_a_sensor_are_R_of_each_range(ranges, k, beta, constant, curvature):
    sensor = SensorModel(
        range_error=k, range_sigma=constant, bearing_sigma=beta, range_curvature=curvature
    )
    R = measurement_noise(sensor, ranges)
    assert R.shape == (len(ranges), 2, 2)
    for r, R_r in zip(ranges, R, strict=True):
        np.testing.assert_allclose(R_r, np.diag([sensor.sigma(r) ** 2, beta**2]), rtol=1e-12)


@given(poses, odometry_controls, shares, shares, shares)
def test_the_heading_is_as_uncertain_as_the_turn(x, u, k_d, k_turn, k_s):
    C = noise.C_odometry(u, k_d, k_turn, k_s)
    assert noise.Q(jacobians.W_odometry(x, u), C)[2, 2] == pytest.approx(C[1, 1])


def test_a_robot_that_stands_still_becomes_no_more_uncertain():
    u = np.zeros(2)
    C = noise.C_odometry(u, 0.1, 0.1, 0.1)
    np.testing.assert_array_equal(noise.Q(jacobians.W_odometry(np.ones(3), u), C), np.zeros((3, 3)))


def test_noise_grows_with_distance_turn_and_range():
    def C(d, turn):
        return np.diag(noise.C_odometry([d, turn], 0.1, 0.2, 0.05))

    assert np.all(C(2.0, 0.5) > C(1.0, 0.5))
    assert C(1.0, 1.0)[1] > C(1.0, 0.5)[1]
    assert noise.R(4.0, 0.01, 0.1)[0, 0] > noise.R(2.0, 0.01, 0.1)[0, 0]


def test_R_holds_variances_not_standard_deviations():
    rng = np.random.default_rng(8)
    r, k, sigma_0, sigma_bearing = 5.0, 0.01, 0.02, 0.03
    ranges = r * (1 + k * rng.standard_normal(200_000)) + sigma_0 * rng.standard_normal(200_000)
    bearings = sigma_bearing * rng.standard_normal(200_000)
    sampled = np.cov(ranges, bearings)
    R = noise.R(r, k, sigma_bearing, sigma_0)
    np.testing.assert_allclose(np.diag(sampled), np.diag(R), rtol=0.03)


@pytest.mark.parametrize("seed", range(5))
def test_Q_is_the_covariance_of_sampled_motions(seed):
    rng = np.random.default_rng(seed)
    x = np.array([*rng.uniform(-5, 5, 2), rng.uniform(-3, 3)])
    u = rng.uniform([0.5, 0.3], [2.0, 1.0])
    C = noise.C_odometry(u, 0.02, 0.05, 0.02)
    controls = rng.multivariate_normal(u, C, 100_000).T
    sampled = np.cov(models.f_odometry(x, controls))
    Q = noise.Q(jacobians.W_odometry(x, u), C)
    scale = np.sqrt(np.outer(np.diag(Q), np.diag(Q)))
    np.testing.assert_allclose(sampled / scale, Q / scale, atol=0.03)


@pytest.mark.parametrize("seed", range(5))
def test_A_carries_the_covariance_of_the_pose_as_sampling_does(seed):
    rng = np.random.default_rng(seed)
    x = np.array([*rng.uniform(-5, 5, 2), rng.uniform(-3, 3)])
    u = rng.uniform([0.5, 0.3], [2.0, 1.0])
    spread = rng.normal(0, 0.02, (3, 3))
    P = spread @ spread.T
    samples = rng.multivariate_normal(x, P, 100_000)
    moved = models.f_odometry(samples.T, u)
    moved[2] = np.unwrap(np.stack([np.full(100_000, x[2] + u[1]), moved[2]]), axis=0)[1]
    A = jacobians.A_odometry(x, u)
    predicted = A @ P @ A.T
    scale = np.sqrt(np.outer(np.diag(predicted), np.diag(predicted)))
    np.testing.assert_allclose(np.cov(moved) / scale, predicted / scale, atol=0.03)
