"""The gate between sources and estimators: what no sensor measures costs its reading alone."""

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from slamlab.estimators.plausibility_check import (
    IN_DEGREES,
    IN_MILLIMETRES,
    NOT_FINITE,
    ODOMETRY_JUMPS,
    TURN_JUMPS,
    PlausibilityCheck,
    checked_scan,
)
from slamlab.readings import Reading, Scan

ANGLES = np.linspace(-np.pi, np.pi, 200, endpoint=False)
RANGES = 3 + np.sin(3 * ANGLES) + 1e-3 * np.random.default_rng(0).standard_normal(200)
SCAN = Scan(ANGLES, RANGES, range_max=12.0, range_min=0.1)


def passed(increments, period=0.2):
    """Increments through a gate, and what it counted."""
    gate = PlausibilityCheck(Counter())
    readings = [
        gate(Reading(period * k, np.array(u, dtype=float))) for k, u in enumerate(increments)
    ]
    return [reading.odometry for reading in readings], gate.counts


@pytest.mark.parametrize("leap", [[40, 0, 0], [0, -5, 0], [1e300, 0, 0], [0, 0, 3.0]])
@pytest.mark.parametrize("row", [1, 30])
def test_a_leap_that_no_robot_makes_in_that_time_is_no_odometry(leap, row):
    drive = [[0.1, 0, 0.02]] * 40
    drive[row] = leap
    odometry, counts = passed(drive)
    assert [k for k, u in enumerate(odometry) if u is None] == [row]
    assert counts == {TURN_JUMPS if leap[2] else ODOMETRY_JUMPS: 1}


@pytest.mark.parametrize("speed", [0.05, 1.0, 10.0])
def test_any_robot_that_speeds_up_and_brakes_passes(speed):
    ramp = speed * np.concatenate([np.zeros(25), np.ones(25), np.zeros(25)])
    ramp = np.convolve(ramp, np.ones(15) / 15, mode="same")  # within three seconds
    _, counts = passed([[0.2 * v, 0, 0.1 * np.sin(k)] for k, v in enumerate(ramp)])
    assert not counts


def test_a_turn_passes_although_its_two_stamps_lie_milliseconds_apart():
    _, counts = passed([[0.01, 0, 0.57]] * 30, period=0.006)
    assert not counts


@pytest.mark.parametrize("distance", [0.7, 2.0])
def test_a_robot_that_restarts_its_odometry_at_some_distance_is_seen(distance):
    odometry, counts = passed([[0.05, 0, 0]] * 40 + [[-distance, 0, 0]] + [[0.05, 0, 0]] * 5)
    assert odometry[40] is None and counts == {ODOMETRY_JUMPS: 1}


def test_after_a_long_gap_a_long_motion_is_possible():
    gate = PlausibilityCheck(Counter())
    for k in range(30):
        gate(Reading(0.1 * k, np.array([0.05, 0, 0])))
    assert gate(Reading(20.0, np.array([8.0, 0, 0]))).odometry is not None


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_odometry_that_is_not_finite_is_none(bad):
    odometry, counts = passed([[0, 0, 0], [0, bad, 0]])
    assert odometry[1] is None and counts == {NOT_FINITE: 1}


def test_a_timestamp_that_is_not_finite_costs_no_reading():
    gate = PlausibilityCheck(Counter())
    times = [gate(Reading(t)).time for t in (1.0, np.nan, np.inf, 1.2)]
    assert times == [1.0, 1.0, 1.0, 1.2]


NO_RETURN = [np.nan, np.inf, -np.inf, 0.0, -1.0, 12.0, 12.5, 11.99, 1e8, 3.4e38, 65.535]


@pytest.mark.parametrize("range_max", [12.0, np.inf])
@pytest.mark.parametrize("written", NO_RETURN)
def test_however_no_return_is_written_it_is_no_point(written, range_max):
    if range_max == np.inf and written in (12.0, 12.5, 11.99, 65.535):
        return  # as far as can be known somebody is there
    lost = np.arange(200) % 10 == 0
    scan = replace(SCAN, ranges=np.where(lost, written, RANGES), range_max=range_max)
    found, _ = checked_scan(scan)
    np.testing.assert_allclose(found.points(), replace(scan, ranges=RANGES).points()[~lost])


def test_an_ordinary_scan_is_handed_on_as_it_is():
    found, anomaly = checked_scan(SCAN)
    assert found is SCAN and not anomaly


@pytest.mark.parametrize(
    ("scan", "anomaly"),
    [
        (Scan(ANGLES, 1000 * RANGES, range_max=12000.0), IN_MILLIMETRES),
        (Scan(np.degrees(ANGLES), RANGES, range_max=12.0), IN_DEGREES),
        (Scan(np.zeros(200), RANGES), "scans without directions"),
        (Scan(ANGLES + np.nan, RANGES), "scans without directions"),
        (Scan(ANGLES[:-1], RANGES), "scans with different numbers of angles and ranges"),
        (Scan(np.empty(0), np.empty(0)), "scans without beams"),
    ],
)
def test_a_scan_that_cannot_be_right_is_empty_and_named(scan, anomaly):
    found, reported = checked_scan(scan)
    assert reported == anomaly and not found.valid.any()


numbers = st.floats(width=32) | st.sampled_from([0.0, 1e8, 3.4e38, np.nan, np.inf])


@given(
    angles=st.lists(numbers, max_size=30),
    ranges=st.lists(numbers, max_size=30),
    range_max=numbers,
    range_min=numbers,
)
def test_only_points_within_reach_of_a_scan_are_left(angles, ranges, range_max, range_min):
    scan = Scan(np.array(angles, float), np.array(ranges, float), range_max, range_min)
    found, _ = checked_scan(scan)
    points = found.points()
    assert np.isfinite(points).all() and np.abs(points).max(initial=0) <= 1000.0
