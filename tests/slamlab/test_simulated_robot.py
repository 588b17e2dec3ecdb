"""The simulated robot as a source: repeatable, its ground truth right, drivable."""

from dataclasses import replace

import numpy as np
import pytest

from slamlab.files import SourceError
from slamlab.geometry import compose, transform
from slamlab.simulation.differential_drive import DifferentialDrive
from slamlab.simulation.range_scanners import RPLIDAR_A2
from slamlab.sources.simulated_robot import (
    ARENA,
    HANDHELD_RUNS,
    LANDMARKS,
    NAMES,
    POLYGON_TRUE_STEPS,
    POLYGON_WRONG_STEPS,
    simulation,
    turn_then_drive,
)
from tests.property_testing import assert_same_pose

SCANNED = [name for name in NAMES if name not in (LANDMARKS, *HANDHELD_RUNS)]
BY_LIDAR = [name for name in SCANNED if name not in ARENA]
PERFECT = DifferentialDrive(tick=1e-9)


def rng(seed=0):
    return np.random.default_rng(seed)


def naive(source):
    """The poses that odometry alone believes in."""
    poses = [np.zeros(3)]
    for reading in source:
        poses.append(compose(poses[-1], reading.odometry))
    return np.array(poses[1:])


@pytest.mark.slow
@pytest.mark.parametrize("name", SCANNED)
def test_the_same_seed_gives_the_same_readings_each_time_and_another_seed_others(name):
    source, other = simulation(name, rng(1)), next(iter(simulation(name, rng(2))))
    readings = list(source)
    assert len(readings) == len(source) == len(source.truth)
    for again in (source, simulation(name, rng(1))):
        for a, b in zip(readings, again, strict=True):
            assert a.time == b.time
            np.testing.assert_array_equal(a.odometry, b.odometry)
            np.testing.assert_array_equal(a.scan.ranges, b.scan.ranges)
    assert not np.array_equal(readings[0].scan.ranges, other.scan.ranges, equal_nan=True)


@pytest.mark.parametrize("name", SCANNED)
def test_each_run_starts_at_the_origin_without_odometry_and_time_goes_on(name):
    source = simulation(name, rng())
    first = next(iter(source))
    np.testing.assert_array_equal(source.truth.poses[0], np.zeros(3))
    np.testing.assert_array_equal(first.odometry, np.zeros(3))
    times = np.array([reading.time for reading in source])
    np.testing.assert_array_equal(times, source.truth.times)
    assert np.all(np.diff(times) > 0)


@pytest.mark.parametrize("name", BY_LIDAR)
def test_scans_seen_from_the_truth_lie_on_the_world(name):
    lidar = replace(RPLIDAR_A2, range_error=0.0, range_curvature=0.0, bearing_sigma=0.0)
    source = simulation(name, rng(), lidar=lidar)
    for reading, pose in zip(source, source.truth.poses, strict=True):
        way = transform(pose, reading.scan.points()) - pose[:2]
        true = source.world.cast(pose[:2], np.arctan2(way[:, 1], way[:, 0]))
        np.testing.assert_allclose(np.hypot(*way.T), true, rtol=1e-3)


@pytest.mark.parametrize("name", ["room", "corridor"])
def test_a_tour_ends_where_it_began_but_raw_odometry_does_not(name):
    source = simulation(name, rng(3))
    truth, believed = source.truth.poses, naive(source)
    assert np.hypot(*truth[-1, :2]) < 0.1
    assert np.hypot(*believed[-1, :2]) > 0.1


def test_the_corridors_ends_miss_each_other_by_metres_for_any_seed():
    for seed in range(5):
        assert np.hypot(*naive(simulation("corridor", rng(seed)))[-1, :2]) > 1.0


@pytest.mark.parametrize("name", ["room", "corridor"])
def test_without_errors_odometry_equals_the_truth(name):
    source = simulation(name, rng(), robot=PERFECT)
    assert_same_pose(naive(source), source.truth.poses, 1e-5)


def test_the_controls_are_what_led_to_each_reading():
    source = simulation("room", rng(), robot=PERFECT)
    first, *others = source
    assert first.control is None
    for reading in others:
        v, omega = reading.control
        way = np.hypot(*reading.odometry[:2])
        assert reading.odometry[2] == pytest.approx(0.5 * omega, abs=1e-6)
        assert way == pytest.approx(0.5 * v * np.sinc(0.25 * omega / np.pi), abs=1e-6)


def test_the_polygons_positions_follow_from_turning_first_and_driving_then():
    heading, place = 0.0, np.zeros(2)
    truth = simulation("polygon", rng()).truth.poses
    for (turn, d), pose in zip(POLYGON_TRUE_STEPS, truth[1:], strict=True):
        heading += turn
        place = place + d * np.array([np.cos(heading), np.sin(heading)])
        assert_same_pose(pose, np.array([*place, heading]))


def test_the_thesis_matrix_of_the_first_step_is_ours_turned_to_its_axes():
    forward, left, _ = turn_then_drive(POLYGON_TRUE_STEPS)[0]
    np.testing.assert_allclose([-left, forward], [0.19304, 0.19304], atol=1e-5)


def test_the_polygon_has_true_odometry_and_its_variant_wrong_odometry_of_the_same_positions():
    right, wrong = simulation("polygon", rng(2)), simulation("polygon-wrong", rng(2))
    np.testing.assert_array_equal(right.truth.poses, wrong.truth.poses)
    assert_same_pose(naive(right), right.truth.poses)
    measured = np.array([reading.odometry for reading in wrong])
    np.testing.assert_array_equal(measured[1:], turn_then_drive(POLYGON_WRONG_STEPS))
    for a, b in zip(right, wrong, strict=True):
        np.testing.assert_array_equal(a.scan.ranges, b.scan.ranges)


def test_a_robot_waits_for_commands_and_each_drive_adds_a_reading():
    source = simulation("room", rng(), robot=PERFECT, tour=False)
    assert len(source) == 1
    reading = source.drive((0.4, 0.0))
    np.testing.assert_allclose(reading.odometry, [0.2, 0, 0], atol=1e-6)
    reading = source.drive([0.0, -0.6])
    np.testing.assert_allclose(reading.odometry, [0, 0, -0.3], atol=1e-6)
    assert len(source) == 3
    assert reading.time == source.truth.times[-1]
    np.testing.assert_array_equal(list(source)[-1].scan.ranges, reading.scan.ranges)


def test_a_toured_run_can_be_driven_on():
    source = simulation("room", rng())
    before = len(source)
    source.drive((0.0, 0.5))
    assert len(list(source)) == before + 1


@pytest.mark.parametrize("v", [0.4, -0.4, 30.0])
def test_a_wall_on_the_path_stops_the_robot(v):
    source = simulation("room", rng(), robot=PERFECT, tour=False)
    for _ in range(60):
        source.drive((v, 0.0))
    truth = source.truth.poses[-1]
    all_round = np.linspace(-np.pi, np.pi, 90)
    assert source.world.cast(truth[:2], all_round).min() > 0.8 * PERFECT.radius
    np.testing.assert_array_equal(source.drive((v, 0.0)).odometry, np.zeros(3))


@pytest.mark.parametrize("command", [None, 1.0, (1.0,), (1, 2, 3), "go", (np.nan, 0.0), ("a", 1)])
def test_a_command_that_is_invalid_is_refused_and_nothing_moves(command):
    source = simulation("room", rng(), tour=False)
    with pytest.raises(SourceError, match="command"):
        source.drive(command)
    assert len(source) == 1


def test_the_polygons_fixed_run_cannot_be_driven():
    with pytest.raises(SourceError, match="sim:polygon is a fixed run"):
        simulation("polygon", rng()).drive((0.1, 0.0))


def test_an_unknown_simulation_is_refused_with_the_available_names():
    with pytest.raises(SourceError, match=r"no simulation 'moon'; available: .*polygon-wrong"):
        simulation("moon", rng())
