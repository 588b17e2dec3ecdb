"""Models: round trips, agreement with the group; test_symbolic has their Jacobians."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from slamlab import models
from slamlab.geometry import compose, inverse, matrix, transform
from slamlab.models import jacobians
from tests.property_testing import (
    assert_same_pose,
    bases,
    observation_vectors,
    odometry_controls,
    periods,
    points,
    poses,
    same_angle,
    steered_controls,
)


@given(poses, observation_vectors)
def test_the_landmark_put_where_it_was_seen_is_seen_there_again(x, z):
    np.testing.assert_allclose(models.h(x, models.g(x, z)), z, atol=1e-9)


@given(poses, points)
def test_the_landmark_seen_is_put_back_where_it_is(x, p):
    np.testing.assert_allclose(models.g(x, models.h(x, p)), p, atol=1e-9)


@given(poses, points, poses)
def test_moving_robot_and_landmark_together_changes_no_observation(x, p, frame):
    assume(np.hypot(*(p - x[:2])) > 0.1)
    moved = (matrix(frame) @ np.append(p, 1))[:2]
    r, bearing = models.h(x, p)
    r_moved, bearing_moved = models.h(compose(frame, x), moved)
    assert r_moved == pytest.approx(r)
    assert abs(np.angle(np.exp(1j * (bearing - bearing_moved)))) < 1e-9


def test_many_landmarks_are_seen_and_placed_at_once_as_one_by_one():
    rng = np.random.default_rng(2)
    x, p = np.array([1.0, -2.0, 2.5]), rng.normal(0, 5, (30, 2))
    np.testing.assert_allclose(models.h(x, p), [models.h(x, q) for q in p])
    z = models.h(x, p)
    np.testing.assert_allclose(models.g(x, z), [models.g(x, one) for one in z])


@given(poses, odometry_controls)
def test_odometry_translates_along_the_old_heading_and_then_turns(x, u):
    assert_same_pose(models.f_odometry(x, u), compose(x, np.array([u[0], 0.0, u[1]])))


@given(poses, steered_controls, bases, periods)
def test_steering_is_composing_with_the_motion_in_the_robots_frame(x, u, B, T):
    V, gamma = u
    motion = [T * V * np.cos(gamma), T * V * np.sin(gamma), T * V / B * np.sin(gamma)]
    assert_same_pose(models.f_steered(x, u, B, T), compose(x, np.array(motion)))


@given(poses, observation_vectors)
def test_the_line_put_where_it_was_seen_is_seen_there_again(x, z):
    rho, alpha = models.h_line(x, models.g_line(x, z))
    assert abs(rho - z[0]) < 1e-9
    assert same_angle(alpha, z[1])


@given(poses, observation_vectors, points)
def test_a_points_distance_to_a_line_is_the_same_from_every_frame(x, line, point):
    """a cos α + b sin α − ρ of a point, in the world and as the robot sees both."""
    outside = point @ [np.cos(line[1]), np.sin(line[1])] - line[0]
    rho, alpha = models.h_line(x, line)
    inside = transform(inverse(x), point[None])[0] @ [np.cos(alpha), np.sin(alpha)] - rho
    assert abs(outside - inside) < 1e-9


@given(st.lists(poses, min_size=1, max_size=3), st.lists(points, min_size=1, max_size=3))
def test_many_poses_at_once_are_what_each_of_them_is_alone(many, p):
    x, p = np.array(many), np.array(p)
    assume(np.min(np.hypot(*(p - x[:, None, :2]).T)) > 0.01)
    z = models.h(x[:, None], p)
    for function, other in [
        *((f, p) for f in (models.h, jacobians.H_robot, jacobians.H_landmark)),
        *((f, z) for f in (models.g, jacobians.J_z)),
    ]:
        together = function(x[:, None], other)
        for k, one in enumerate(x):
            alone = function(one, other if other is p else other[k])
            np.testing.assert_allclose(together[k], alone, rtol=1e-12, atol=1e-12)
