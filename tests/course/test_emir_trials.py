"""Trials of lesson 14: what scans, runs and counters determine."""

import numpy as np
import pytest

from course.studies import emir_trials as trials
from slamlab.devices.emulator.synthetic_recording import record_synthetic_run
from slamlab.simulation import worlds


def test_an_arc_determines_sign_and_front():
    arc = trials.two_scans(25, 25)
    others = range(15, 360, 15)
    assert arc.misfit() < 1 < min(arc.misfit(front=front) for front in others)
    assert min(arc.misfit(False, front) for front in (0, *others)) > 10


def test_in_a_rectangle_the_median_does_not_find_a_wrong_sign_after_a_quarter_turn():
    rectangle = worlds.World(worlds.box((0, 0), (6, 4)), name="rectangle")
    pair = trials.two_scans(25, 25, 4.1, world=rectangle)
    assert pair.misfit(False) < 1
    assert pair.misfit(False, percentile=90) > 40
    assert pair.misfit(percentile=90) < 2


def test_straight_ahead_a_mirrored_scan_fits_as_well():
    ahead = trials.two_scans(25, 0)
    assert ahead.misfit() < 1 and ahead.misfit(clockwise=False) < 1
    assert ahead.misfit(front=20) > 1


def test_turning_on_the_spot_determines_the_sign_and_no_front():
    spot = trials.two_scans(0, 25)
    assert spot.misfit() < 1 and spot.misfit(front=40) < 1
    assert spot.misfit(clockwise=False) > 10


def test_statuses_hold_the_counters_of_the_body_in_a_byte():
    found, body = trials.statuses_of([(8, 100, 0), (1, 0, 0)], worlds.corridor())
    assert body.counters()[0] > 255
    assert (found[-1].path - body.counters()[0]) % 256 == 0


@pytest.mark.parametrize("seed", [0, 1])
def test_a_count_of_twice_the_size_makes_a_round_of_twice_the_size(seed):
    trip = trials.round_trip(seed)
    assert trip.counts.dtype == np.int8
    small, large = trip.track(1, 2.14), trip.track(2, 2.14)
    np.testing.assert_allclose(large[:, :2], 2 * small[:, :2], atol=1e-9)
    np.testing.assert_allclose(large[:, 2], small[:, 2])


def test_right_counts_leave_what_the_wheels_slip():
    trips = [trials.round_trip(seed) for seed in range(6)]
    right, wrong = ([each.error(1.03, degrees) for each in trips] for degrees in (2.14, 2.0))
    assert np.median(right) < np.median(wrong)
    assert min(right) > 1, "six robots slip"


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 2, 3, 6])
def test_motion_distortion_and_latency_make_a_mapped_recording_worse(tmp_path, seed):
    path, rng = tmp_path / "turn.rec", np.random.default_rng(seed)
    motions = [(0.5, 0, 0), *trials.ROUND, (0.5, 0, 0)]
    true = record_synthetic_run(path, worlds.room(), rng, motions)
    ways = {"right": {}, "skewed": {"deskewed": False}, "late": {"latency": 0.1}}
    right, skewed, late = trials.mapping_errors(path, true, ways).values()
    assert right < min(skewed, late)
    if seed != 6:  # the lesson maps seed 6, and gives these ranges for the others
        assert 3 <= round(right) <= 4
        assert 6 <= round(skewed) <= 14
        assert 4 <= round(late) <= 7
