"""Clouds far from their origin, such as in map coordinates, are matched as at the origin."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from slamlab.geometry import between, compose, transform
from slamlab.scanmatching import match, normals, preprocess, rigid_fit
from slamlab.scanmatching.submap import build_submap
from tests.slamlab.room_clouds import ALL, MOTION, OFF, clouds, error, seeds


def shifted(pose, centre):
    """A pose between clouds that both have been moved by a centre."""
    x, y, turn = pose
    return np.array([*(np.array([x, y]) + centre - transform([0, 0, turn], [centre])[0]), turn])


distances = st.floats(1.2, 6).map(lambda exponent: 10**exponent)


@ALL
@settings(max_examples=15)
@given(seeds, distances, st.floats(-np.pi, np.pi))
@example(seed=0, distance=1e6, bearing=np.pi)
def test_moving_both_clouds_far_away_changes_nothing(matcher, seed, distance, bearing):
    rng = np.random.default_rng(seed)
    both = [rng.permutation(cloud) for cloud in clouds(seed % 5)]
    both = [cloud - cloud.mean(axis=0) for cloud in both]
    near = matcher(*both, OFF)
    centre = distance * np.array([np.cos(bearing), np.sin(bearing)])
    guess = shifted(OFF, centre)
    away = matcher(*(cloud + centre for cloud in both), guess, history=True)
    np.testing.assert_allclose(away.history[0].pose, guess, atol=1e-8)
    np.testing.assert_allclose(away.history[-1].pose, away.pose, atol=1e-8)
    assert away.verdict == near.verdict
    assert away.iterations == near.iterations
    # a millionth of the noise, but numbers of 1e6 m have no more digits
    np.testing.assert_allclose(shifted(away.pose, -centre), near.pose, rtol=0, atol=5e-9)


@pytest.mark.parametrize("as_surface", [False, True])
def test_a_scan_is_matched_with_a_map_far_from_its_origin(as_surface):
    here = np.array([4e5, 5e6, 1.2])
    source, target = clouds(0)
    target = transform(here, target)
    if as_surface:
        target = preprocess(target)
    found = match(source, target, compose(here, MOTION + OFF))
    assert found.good
    assert error(found, compose(here, MOTION))[0] < 0.005
    # observed from the scan position, as near the origin: so is its covariance
    near = match(*clouds(0), MOTION + OFF).covariance
    assert (np.diag(found.covariance) < 3 * np.diag(near).max()).all()


def test_the_covariance_of_point_clouds_far_away_is_that_at_the_origin_transformed():
    rng = np.random.default_rng(0)
    source, target = (rng.permutation(cloud) for cloud in clouds(0))
    centre = np.array([700.0, -200.0])
    near, away = match(source, target, MOTION), None
    away = match(source + centre, target + centre, shifted(MOTION, centre))
    dx, dy = transform([0, 0, near.pose[2]], [centre])[0]
    J = np.array([[1, 0, dy], [0, 1, -dx], [0, 0, 1]])
    for sigma in (0.0, 0.01):
        expected = J @ near.inflated_covariance(sigma) @ J.T
        got = away.inflated_covariance(sigma)
        scale = np.sqrt(np.diag(expected))
        np.testing.assert_allclose(got / scale / scale[:, None], expected / scale / scale[:, None],
                                   atol=0.1)  # fmt: skip


@given(seeds, distances)
def test_normals_and_rigid_fits_know_no_distance(seed, distance):
    cloud, rng = clouds(seed % 5)[0], np.random.default_rng(seed)
    centre = distance * np.array([0.6, 0.8])
    lines = normals(cloud)
    known = np.isfinite(normals(cloud + centre)[:, 0]) & np.isfinite(lines[:, 0])
    assert np.mean(known == np.isfinite(lines[:, 0])) > 0.99
    assert np.allclose(normals(cloud + centre)[known], lines[known], atol=1e-5)
    pose = rng.normal(size=3)
    fitted = rigid_fit(cloud + centre, transform(pose, cloud) + centre)
    np.testing.assert_allclose(shifted(fitted, -centre), pose, atol=1e-8)


def test_a_submap_far_away_is_matched_like_one_at_the_origin():
    made = [preprocess(cloud) for cloud in clouds(0)]
    poses = np.array([MOTION, np.zeros(3)])
    source, here = clouds(1)[0], np.array([3e5, -4e5, 0.7])
    near = match(source, build_submap(made, poses), MOTION + OFF)
    away = match(source, build_submap(made, compose(here, poses)), compose(here, MOTION + OFF))
    np.testing.assert_allclose(between(here, away.pose), near.pose, atol=2e-3)
    assert away.good


def test_the_correlative_search_is_made_about_the_centres():
    centre = np.array([2e5, 1e5])
    turned = MOTION + np.array([0, 0, 2.4])
    found = match(*(cloud + centre for cloud in clouds(0)), shifted(turned, centre))
    assert found.searched
    assert found.good
    assert error(found, shifted(MOTION, centre))[1] < 0.005
