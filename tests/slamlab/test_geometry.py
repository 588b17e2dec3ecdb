"""The laws of angle wrapping and of SE(2), the group of poses in the plane."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from slamlab.geometry import between, compose, from_matrix, inverse, matrix, transform, wrap
from tests.property_testing import assert_same_pose, points, poses, same_angle


@given(st.floats(-1e6, 1e6))
def test_wrapping_stays_in_its_interval_and_keeps_the_direction(angle):
    wrapped = wrap(angle)
    assert -np.pi < wrapped <= np.pi
    assert same_angle(wrapped, angle, 1e-8)


@pytest.mark.parametrize("angle", [np.pi, -np.pi, 3 * np.pi, -3 * np.pi])
def test_half_a_turn_is_plus_pi_and_its_neighbours_stay_inside(angle):
    assert wrap(angle) == pytest.approx(np.pi)
    for near in (np.nextafter(angle, 9), np.nextafter(angle, -9)):
        assert -np.pi < wrap(near) <= np.pi


def test_wrapping_takes_arrays_of_any_shape_and_scalars():
    assert np.shape(wrap(np.zeros((2, 3)))) == (2, 3)
    assert np.shape(wrap(7)) == ()


@given(poses, poses, poses)
def test_composition_is_associative(a, b, c):
    assert_same_pose(compose(compose(a, b), c), compose(a, compose(b, c)))


@given(poses)
def test_a_pose_and_its_inverse_cancel_on_both_sides(a):
    assert_same_pose(compose(a, inverse(a)), np.zeros(3))
    assert_same_pose(compose(inverse(a), a), np.zeros(3))


@given(poses, poses)
def test_between_is_what_leads_from_one_pose_to_the_other(a, b):
    assert_same_pose(compose(a, between(a, b)), b)


@given(poses, poses, poses)
def test_between_does_not_depend_on_the_frame(a, b, frame):
    assert_same_pose(between(compose(frame, a), compose(frame, b)), between(a, b), 1e-8)


@given(poses, poses)
def test_composition_is_the_product_of_matrices(a, b):
    np.testing.assert_allclose(matrix(compose(a, b)), matrix(a) @ matrix(b), atol=1e-9)


@given(poses)
def test_a_matrix_gives_its_pose_back(a):
    assert_same_pose(from_matrix(matrix(a)), a)


@given(poses, points)
def test_transforming_points_is_the_matrix_on_column_vectors(pose, point):
    moved = matrix(pose) @ np.append(point, 1)
    np.testing.assert_allclose(transform(pose, point[None])[0], moved[:2], atol=1e-9)


def test_many_poses_are_composed_at_once_as_one_by_one():
    rng = np.random.default_rng(4)
    a, b = rng.normal(0, 3, (2, 50, 3))
    one_by_one = np.array([compose(p, q) for p, q in zip(a, b, strict=True)])
    np.testing.assert_allclose(compose(a, b), one_by_one)
    np.testing.assert_allclose(inverse(a), [inverse(p) for p in a])
    np.testing.assert_allclose(compose(a[0], b), [compose(a[0], q) for q in b])
