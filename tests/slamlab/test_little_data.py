"""Every estimator with too little or impossible data continues and reports it."""

from dataclasses import replace

import numpy as np
import pytest

from slamlab import estimators
from slamlab.estimators.estimate_warnings import MIN_STEPS
from slamlab.simulation import RPLIDAR_A2
from slamlab.simulation.worlds import World
from slamlab.sources import simulation
from tests.slamlab.support import Given

SLAMS = [name for name in estimators.NAMES if name != "odometry"]
STEPS = 2 * MIN_STEPS
ROOM = simulation("room", np.random.default_rng(1))
READINGS = list(ROOM)[:STEPS]


def taken_in(name, readings, like=ROOM):
    """The estimator after some readings, found to be sound: all that it shows is finite."""
    slam = estimators.make(name, Given(readings, like))
    for reading in readings:
        slam.step(reading)
    poses = slam.trajectory().poses
    assert poses.shape == (len(readings), 3) and np.isfinite(poses).all()
    for layer in slam.layers():
        assert all(np.isfinite(rows).all() for rows in vars(layer).values() if np.ndim(rows))
    assert all(f"warning: {sentence}" in slam.status for sentence in slam.warnings)
    return slam


def with_points(count):
    """The readings, each scan with its first so many points alone."""
    return [replace(r, scan=_thinned(r.scan, count)) for r in READINGS]


def _thinned(scan, count):
    there = np.flatnonzero(scan.valid)[:count]
    ranges = np.full_like(scan.ranges, np.nan)
    ranges[there] = scan.ranges[there]
    return replace(scan, ranges=ranges)


def in_a_box(side):
    """Readings of a robot that turns on the spot in a square room [m]."""
    a = side / 2
    walls = World([[-a, -a, a, -a], [a, -a, a, a], [a, a, -a, a], [-a, a, -a, -a]])
    rng, turn = np.random.default_rng(2), np.array([0.0, 0.0, 0.2])
    return [
        replace(r, odometry=turn * (k > 0), scan=RPLIDAR_A2.scan(walls, k * turn, rng))
        for k, r in enumerate(READINGS)
    ]


TOO_LITTLE = {
    "no point": with_points(0),
    "one point": with_points(1),
    "three points": with_points(3),
    "one scan, then none": [READINGS[0], *(replace(r, scan=None) for r in READINGS[1:])],
    "a room nearer than the lidar sees": in_a_box(0.2),
}


@pytest.mark.parametrize("readings", [[], READINGS[:1]], ids=["none", "one"])
@pytest.mark.parametrize("name", estimators.NAMES)
def test_for_at_most_one_reading_nothing_is_reported(name, readings):
    assert not taken_in(name, readings).warnings


@pytest.mark.parametrize("readings", TOO_LITTLE.values(), ids=TOO_LITTLE)
@pytest.mark.parametrize("name", SLAMS)
def test_an_estimator_with_too_few_observations_goes_on_and_reports_it(name, readings):
    assert taken_in(name, readings).warnings


@pytest.mark.parametrize("name", SLAMS)
def test_an_estimator_that_loses_all_observations_reports_it(name):
    blind = [replace(r, scan=_thinned(r.scan, 0)) for r in READINGS]
    away = [replace(r, odometry=np.array([0.5, 0.0, 0.1])) for r in blind]
    assert taken_in(name, [*READINGS[:MIN_STEPS], *away]).warnings


def with_steps(*steps):
    """The readings, with some odometry, or none, in every fifth of them from the 20th on."""
    readings = list(READINGS)
    for k, step in zip(range(20, STEPS, 5), steps, strict=False):
        step = None if step is None else np.array(step, float)
        readings[k] = replace(readings[k], odometry=step)
    return readings


@pytest.mark.parametrize("name", estimators.NAMES)
def test_a_jump_of_the_odometry_is_left_out_and_counted(name):
    slam = taken_in(name, with_steps([1e3, -5e2, 2.0], [np.nan] * 3, [40.0, 0.0, 0.0]))
    without = taken_in(name, with_steps(None, None, None))
    np.testing.assert_array_equal(slam.trajectory().poses, without.trajectory().poses)
    assert slam.counts.total() >= 3
    assert "2 odometry jumps" in slam.status and "1 odometry increments not" in slam.status


@pytest.mark.parametrize("name", estimators.NAMES)
def test_a_long_step_or_many_turns_at_once_break_nothing(name):
    taken_in(name, with_steps([2.0, 0.0, 0.0], [0.0, 0.0, 40.0]))


def test_odometry_alone_beside_a_run_leaves_out_the_same_jumps():
    source = Given(with_steps(np.full(3, np.nan)), ROOM)
    result = estimators.run(source, estimators.DeadReckoning())
    np.testing.assert_array_equal(result.naive.poses, result.trajectory.poses)
