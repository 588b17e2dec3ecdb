"""Lesson 10: what edges lose beyond a right angle, what one lie does, box beside ellipse."""

import numpy as np
import pytest

from slamlab.sources.landmark_runs import LandmarkRun, Loop
from slamlab.studies.boxes import BoundedNoise
from slamlab.studies.broken_bounds import cut_off, objects_made, one_bad_range, race

LOOP = Loop(v_sigma=0.004, omega_sigma=0.0024, range_sigma=0.02, bearing_sigma=0.007, steps=60)


@pytest.mark.parametrize("d_r", [0.0, 0.4, 1.5])
def test_edges_lose_nothing_below_a_right_angle_and_more_and_more_beyond(d_r):
    assert [cut_off(d_r, d_abs, r=2.0) for d_abs in (0.0, 0.5, 1.5)] == [0, 0, 0]
    lost = [cut_off(d_r, d_abs, r=2.0) for d_abs in (1.7, 2.3, 3.1)]
    assert 0 < lost[0] < lost[1] < lost[2]


def test_an_honest_range_is_never_reported_and_a_gross_lie_at_once():
    assert {one_bad_range(seed, 0.0) for seed in range(10)} == {(None, False)}
    times = 3 / BoundedNoise().seeing[0]  # 3 m too long: from elsewhere in the world
    assert all(one_bad_range(seed, times)[0] == 0 for seed in range(10))


def test_a_new_object_for_each_ambiguous_sighting_makes_more_of_them():
    for seed in range(3):
        assert objects_made(seed, several_are_new=True) > objects_made(seed, several_are_new=False)


def test_bounds_that_hold_keep_the_truth_and_shares_above_one_are_outside():
    found = race(LandmarkRun(LOOP, np.random.default_rng(1)), sigmas=5.0)
    assert not found.outside.any()
    assert np.nanmax(found.box_share) <= 1 + 1e-9
    tight = race(LandmarkRun(LOOP, np.random.default_rng(1)), sigmas=0.3)
    assert tight.outside[np.nan_to_num(tight.box_share) > 1 + 1e-6].all()
    assert tight.outside.any()


def test_a_bias_reaches_the_wheels_and_the_ellipse_alike():
    run = LandmarkRun(LOOP, np.random.default_rng(2))
    straight, biased = race(run), race(run, bias=0.02)
    for name in ("wheels", "ellipse"):
        assert biased.rms()[name] > straight.rms()[name]
