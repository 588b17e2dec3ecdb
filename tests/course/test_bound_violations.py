"""Studies of lesson 10: excluded positions of four edges, one outlier, box and ellipse compared."""

import numpy as np
import pytest

from course.studies.bound_violations import (
    beyond_bounds,
    compare_filters,
    count_landmarks,
    cut_off,
    one_bad_range,
)
from course.studies.box_containment import BoundedNoise
from slamlab.sources.landmark_runs import LandmarkRun, Loop

LOOP = Loop(v_sigma=0.004, omega_sigma=0.0024, range_sigma=0.02, bearing_sigma=0.007, steps=60)


@pytest.mark.parametrize("d_r", [0.0, 0.4, 1.5])
def test_edges_lose_nothing_below_a_right_angle_and_more_and_more_beyond(d_r):
    assert [cut_off(d_r, d_abs, r=2.0) for d_abs in (0.0, 0.5, 1.5)] == [0, 0, 0]
    lost = [cut_off(d_r, d_abs, r=2.0) for d_abs in (1.7, 2.3, 3.1)]
    assert 0 < lost[0] < lost[1] < lost[2]


def test_a_range_within_its_bound_is_never_reported_and_a_gross_outlier_at_once():
    assert {one_bad_range(seed, 0.0) for seed in range(10)} == {(None, 0)}
    times = 3 / BoundedNoise().seeing[0]  # 3 m too long: from elsewhere in the world
    assert all(one_bad_range(seed, times)[0] == 0 for seed in range(10))


def test_a_new_landmark_for_each_ambiguous_observation_adds_landmarks():
    for seed in range(3):
        ignored, added = (count_landmarks(seed, add_ambiguous=add) for add in (False, True))
        assert added > ignored


def test_gaussian_errors_exceed_a_bound_as_often_as_their_density_predicts():
    runs = [LandmarkRun(LOOP, np.random.default_rng(seed)) for seed in range(5)]
    total = sum(2 * LOOP.steps + sum(2 * len(r.observations.ids) for r in run) for run in runs)
    for sigmas, share in ((1, 0.317), (2, 0.0455)):
        counted = np.sum([beyond_bounds(run, sigmas) for run in runs], axis=0)
        assert counted[1] == total
        assert counted[0] / total == pytest.approx(share, rel=0.15)


def test_bounds_that_hold_keep_the_truth_and_shares_above_one_are_outside():
    found = compare_filters(LandmarkRun(LOOP, np.random.default_rng(1)), sigmas=5.0)
    assert not found.outside.any()
    assert np.nanmax(found.box_share) <= 1 + 1e-9
    tight = compare_filters(LandmarkRun(LOOP, np.random.default_rng(1)), sigmas=0.3)
    assert tight.outside[np.nan_to_num(tight.box_share) > 1 + 1e-6].all()
    assert tight.outside.any()


def test_a_bias_affects_odometry_and_the_ellipse_equally():
    run = LandmarkRun(LOOP, np.random.default_rng(2))
    straight, biased = compare_filters(run), compare_filters(run, bias=0.02)
    for name in ("wheels", "ellipse"):
        assert biased.rms()[name] > straight.rms()[name]
