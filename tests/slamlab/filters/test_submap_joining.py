"""Submaps: nothing is lost by filtering in local maps and joining them."""

import numpy as np
import pytest

from slamlab.estimators.ekf_slam import EkfSlam
from slamlab.evaluation import band, nees
from slamlab.filters.ekf_slam_filter import MAK
from slamlab.filters.submap_joining import JoinedMap
from slamlab.geometry import wrap
from slamlab.sources.landmark_runs import LandmarkRun, Loop

LOOP = Loop(steps=84, landmarks=16, range_max=3.0)
LENGTH = 12  # steps of a submap


def in_submaps(source, length=LENGTH):
    """The run filtered in submaps; one begins with what the last pose of the one before saw."""
    whole, submap, since = JoinedMap(), EkfSlam(source.robot, source.sensor), 0
    for reading in source:
        submap.step(reading)
        since += 1
        if since == length:
            whole.join(submap.filter)
            submap, since = EkfSlam(source.robot, source.sensor), 0
    whole.join(submap.filter)
    return whole


def at_once(source):
    slam = EkfSlam(source.robot, source.sensor)
    for reading in source:
        slam.step(reading)
    return slam.filter


def quiet(seed):
    """A run with so little noise that every Jacobian is exact."""
    small = {"v_sigma": 2e-6, "omega_sigma": 2e-6, "range_sigma": 1e-5, "bearing_sigma": 2e-6}
    loop = Loop(steps=84, landmarks=16, range_max=3.0, **small)
    return LandmarkRun(loop, np.random.default_rng(seed))


@pytest.mark.parametrize("seed", range(3))
def test_where_jacobians_are_exact_submaps_give_what_one_filter_gives(seed):
    source = quiet(seed)
    whole, full = in_submaps(source), at_once(source)
    assert set(whole.ids) == set(full.ids)
    order = [full.ids.index(i) for i in whole.ids]
    rows = np.concatenate([[0, 1, 2], *([3 + 2 * k, 4 + 2 * k] for k in order)])
    sigma = np.sqrt(np.diag(full.P))[rows]
    assert np.all(np.abs(wrap(whole.x - full.x[rows])) < 1e-2 * sigma)
    np.testing.assert_allclose(whole.P, full.P[np.ix_(rows, rows)], atol=1e-3 * sigma.max() ** 2)


def test_joined_maps_are_consistent():
    runs, found = 20, []
    for seed in range(runs):
        source = LandmarkRun(LOOP, np.random.default_rng(seed))
        whole = in_submaps(source)
        error = whole.pose - source.truth.poses[-1]
        error[2] = wrap(error[2])
        found.append(nees(error, whole.P[:3, :3]))
    low, high = band(3, runs, 0.9999)
    assert low < np.mean(found) < high


def test_the_covariance_is_one_and_each_landmark_stands_once():
    source = LandmarkRun(LOOP, np.random.default_rng(5))
    whole = in_submaps(source)
    assert len(set(whole.ids)) == len(whole.ids) == len(whole.landmarks())
    np.testing.assert_allclose(whole.P, whole.P.T, atol=1e-12)
    assert np.linalg.eigvalsh(whole.P).min() > -1e-12
    off = whole.landmarks() - source.landmarks[whole.ids]
    assert np.hypot(*off.T).max() < 1.0


def test_one_submap_is_the_map_itself():
    source = LandmarkRun(LOOP, np.random.default_rng(6))
    full, whole = at_once(source), JoinedMap()
    whole.join(full)
    np.testing.assert_allclose(whole.x, full.x, atol=1e-15)
    np.testing.assert_allclose(whole.P, full.P, atol=1e-15)


def test_a_landmark_that_both_know_without_error_is_refused_and_nothing_changes():
    z, exact = np.array([[2.0, 0.3]]), np.zeros((2, 2))
    submap, whole = MAK(np.zeros(3), np.zeros((3, 3))), JoinedMap()
    submap.add([7], z, exact)
    whole.join(submap)
    with pytest.raises(ValueError, match="zero variance in both"):
        whole.join(submap)
    assert whole.ids == [7] and len(whole.x) == 5
