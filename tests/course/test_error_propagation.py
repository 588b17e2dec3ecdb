"""Studies of lesson 04: derivatives are Jacobians, linearisation holds for small errors only."""

import numpy as np
import pytest

from course.studies import error_propagation
from slamlab import models
from slamlab.models import jacobians, noise
from slamlab.models.finite_differences import numerical_jacobian

X, U, Z = np.array([1.2, -0.7, 0.9]), np.array([1.3, 0.4]), np.array([3.1, 1.1])
EXACT = np.zeros((2, 2))


def test_central_differences_give_the_jacobian_column_by_column():
    found = numerical_jacobian(lambda x: models.f_odometry(x, U), X)
    assert np.allclose(found, jacobians.A_odometry(X, U), atol=1e-9)
    assert numerical_jacobian(lambda z: models.g(X, z), Z).shape == (2, 2)


def test_central_differences_leave_their_argument_and_take_whole_numbers():
    at = np.array([1, 2])
    assert np.allclose(numerical_jacobian(lambda v: v**2, at), np.diag([2, 4]))
    assert at.dtype.kind == "i" and at.tolist() == [1, 2]


@pytest.mark.parametrize(("sigma", "at_most"), [(0.02, 0.001), (0.6, 0.7)])
def test_linearisation_predicts_end_poses_if_the_heading_variance_is_small(sigma, at_most):
    P = np.diag([0.05, 0.05, sigma]) ** 2
    ends = error_propagation.sample_end_poses(
        X, P, [3.0, 0.3], EXACT, np.random.default_rng(4), 20_000
    )
    behind = np.linalg.norm(models.f_odometry(X, [3.0, 0.3])[:2] - ends[:, :2].mean(axis=0))
    assert abs(behind - 3 * (1 - np.exp(-(sigma**2) / 2))) < 0.02  # the mean of a cosine
    assert behind < at_most + 0.01


def test_a_new_landmark_has_the_covariance_of_its_sampled_positions():
    P, R = np.diag([0.1, 0.1, 0.03]) ** 2, noise.R(Z[0], 0.02, 0.02)
    J_r, J_z = jacobians.J_xr(X, Z), jacobians.J_z(X, Z)
    marks = error_propagation.sample_landmarks(X, P, Z, R, np.random.default_rng(4), 20_000)
    claimed = error_propagation.new_landmark(P, J_r, J_z, R)
    assert np.allclose(np.cov(marks.T), claimed, atol=0.05 * np.trace(claimed))
    assert error_propagation.landmark_nees(X, Z, R, P, J_r, J_z) == pytest.approx(2, abs=0.3)
    assert error_propagation.landmark_nees(X, Z, R, P, 0 * J_r, J_z) > 4


def test_a_wrong_sign_keeps_the_error_and_shrinks_the_covariance():
    (right, sure), (wrong, believed) = (
        error_propagation.localisation_errors(k, 3) for k in (1, -1)
    )
    assert right[-1] < min(1.5 * sure[-1], 0.3 * right[0])
    assert wrong[-1] > 4 * believed[-1]
    assert believed[-1] == pytest.approx(sure[-1], rel=0.2)
