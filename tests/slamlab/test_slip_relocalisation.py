"""Walls in the arena by a short-sighted sensor; a robot whose wheels slipped is found again."""

import numpy as np
import pytest

from slamlab.estimators.slip_relocalisation import MIN_SCANS, RELOCALISATIONS
from slamlab.estimators.wall_map_fit import distances_to_walls, fraction_through_walls
from slamlab.estimators.wall_slam import WallSlam, observed_walls
from slamlab.evaluation import nees
from slamlab.geometry import compose, wrap
from slamlab.landmarks.ransac import lines
from slamlab.models.parameters import RobotModel, SensorModel
from slamlab.readings import Reading, Scan
from slamlab.simulation.range_scanners import GP2D120, RPLIDAR_A2
from slamlab.simulation.worlds import arena
from slamlab.sources.arena_runs import ArenaRun

SEEDS = 41, 42
SLIPPED = "the wheels may have slipped"

LOST = 0.12  # [m]: farther off, a robot is lost


def driven(source, **options):
    """EKF-SLAM with walls after a drive, and after each step P of its pose, errors, warnings."""
    slam = WallSlam(source.robot, source.sensor, np.random.default_rng(0), **options)
    P, warned = [], []
    for reading in source:
        slam.step(reading)
        P.append(slam.filter.block([0, 1, 2]))
        warned.append(any(SLIPPED in warning for warning in slam.warnings))
    errors = slam.trajectory().poses - source.truth.poses
    errors[:, 2] = wrap(errors[:, 2])
    return slam, np.array(P), errors, np.array(warned)


def off(errors):
    """(n,) position errors [m]."""
    return np.hypot(*errors[:, :2].T)


@pytest.fixture(scope="module")
def free():
    return [driven(ArenaRun(np.random.default_rng(seed))) for seed in SEEDS]


@pytest.fixture(scope="module", params=SEEDS)
def snagged(request):
    source = ArenaRun(np.random.default_rng(request.param)).snagged()
    return source, driven(source)


def test_a_short_range_sensor_sees_walls_and_a_lidar_sees_what_it_always_saw():
    pose = np.zeros(3)
    for scanner, short in ((GP2D120, True), (RPLIDAR_A2, False)):
        scan = scanner.scan(arena(), pose, np.random.default_rng(1))
        seen = observed_walls(scan, scanner.model, np.random.default_rng(2))
        by_default = lines(scan, scanner.model, np.random.default_rng(2))
        if short:
            assert len(seen) > len(by_default)
        else:
            np.testing.assert_array_equal([w.z for w in seen], [w.z for w in by_default])


def dead_reckoned(source):
    """Where dead reckoning ends."""
    pose = np.zeros(3)
    for reading in source:
        pose = compose(pose, reading.odometry)
    return pose


@pytest.mark.slow
def test_after_three_laps_of_the_arena_it_is_off_by_millimetres_and_odometry_by_centimetres(free):
    for seed, (_, _, errors, _) in zip(SEEDS, free, strict=True):
        source = ArenaRun(np.random.default_rng(seed))
        naive = np.hypot(*(dead_reckoned(source) - source.truth.poses[-1])[:2])
        assert off(errors)[-1] < 0.01 < 0.02 < naive


def test_a_robot_that_did_not_slip_is_never_relocalised_and_goes_as_without(free):
    for slam, *_ in free:
        assert slam.counts[RELOCALISATIONS] == 0
    without, *_ = driven(ArenaRun(np.random.default_rng(SEEDS[0])), relocalise=False)
    np.testing.assert_array_equal(without.trajectory().poses, free[0][0].trajectory().poses)


@pytest.mark.slow
def test_a_robot_that_slipped_is_found_again_where_it_is_lost_without(snagged):
    source, (slam, _, errors, _) = snagged
    without, _, lost, _ = driven(source, relocalise=False)
    assert np.hypot(*(dead_reckoned(source) - source.truth.poses[-1])[:2]) > LOST
    assert off(lost)[-1] > LOST
    assert off(errors)[-1] < 0.01
    assert slam.counts[RELOCALISATIONS] == 1
    assert "1 relocalisations" in slam.status
    # what it took for new walls is forgotten
    assert len(slam.filter.ids) < len(without.filter.ids)


def test_once_it_is_relocalised_its_covariance_holds_its_errors(snagged):
    source, (_, P, errors, _) = snagged
    again = source.snag + 3 * MIN_SCANS
    assert np.median(nees(errors[again:], P[again:])) < 9


def test_a_possible_slip_is_reported_until_it_is_relocalised(snagged):
    source, (_, _, _, warned) = snagged
    assert warned[source.snag : source.snag + 3 * MIN_SCANS].any()
    assert not warned[-1]


def test_a_point_is_as_far_from_a_wall_as_from_what_was_seen_of_it_and_no_wall_faces_backwards():
    wall = np.array([[1.0, 0.0, -0.5, 0.5]])  # x = 1, seen from the left
    points = np.array([[1.0, 0.2], [0.7, 0.0], [1.3, 0.9]])
    before, turned, behind = [0.0, 0, 0], [1.0, 0, np.pi / 2], [2.0, 0, np.pi]
    np.testing.assert_allclose(
        distances_to_walls(np.array([before]), points, wall), [[0, 0.3, 0.5]]
    )
    np.testing.assert_allclose(
        distances_to_walls(np.array([turned]), points, wall),
        [[np.hypot(0.2, 0.5), 0.2, np.hypot(0.9, 0.8)]],
    )
    assert np.isinf(distances_to_walls(np.array([behind]), points, wall)).all()


def test_no_beam_goes_through_walls_from_where_the_robot_is_and_many_do_from_behind_them():
    ahead = np.array([[1.0, 0.0, -5.0, 5.0]])  # x = 1, seen from the left
    angles = np.linspace(-1, 1, 41)
    scan = Scan(angles, 1 / np.cos(angles), range_max=4.0)
    through = [
        fraction_through_walls(np.array(pose), scan, ahead, SensorModel(range_max=4.0))
        for pose in ([0.0, 0, 0], [0.5, 0, 0], [-0.5, 0, 0], [1.5, 0, 0])
    ]
    assert through == [0, 1, 0, 0]
    empty = Scan(angles, np.full(41, np.nan), range_max=4.0)
    assert fraction_through_walls(np.zeros(3), empty, ahead, SensorModel(range_max=4.0)) == 1


def test_a_sensor_without_a_range_and_a_map_without_walls_are_no_trouble():
    endless = Scan(np.linspace(-1, 1, 9), np.array([2.0] * 8 + [np.nan]))
    no_walls, sensor = np.empty((0, 4)), SensorModel(range_curvature=0.1)
    assert fraction_through_walls(np.zeros(3), endless, no_walls, sensor) == 0
    assert np.isinf(distances_to_walls(np.zeros((1, 3)), endless.points(), no_walls)).all()
    slam = WallSlam(RobotModel(), sensor, np.random.default_rng(0))
    straight = np.linspace(-1, 1, 81)
    for ranges in (np.full(81, np.nan), 1 / np.cos(straight), 1.5 / np.cos(straight)):
        slam.step(Reading(0.0, np.array([0.1, 0, 0]), scan=Scan(straight, ranges)))
    assert slam.counts[RELOCALISATIONS] == 0
