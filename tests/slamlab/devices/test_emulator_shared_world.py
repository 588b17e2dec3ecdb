"""The emulated devices share one world: eMIR's commands move the robot, the lidar sees it move."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from slamlab.devices.emulator.emulated_robot import EmulatedRobot
from slamlab.devices.emulator.motion_distortion import MovingLidar
from slamlab.simulation import worlds
from slamlab.simulation.differential_drive import DifferentialDrive
from slamlab.simulation.range_scanners import RPLIDAR_A2
from slamlab.simulation.worlds.ray_casting import cast_each_ray
from slamlab.simulation.worlds.world import World
from tests.slamlab.devices.emulator_helpers import HALL, body_in

NOISELESS = replace(
    RPLIDAR_A2, range_error=0.0, range_curvature=0.0, bearing_sigma=0.0, dropouts=0.0
)


@pytest.mark.parametrize("name", ["polygon", "room", "corridor", "table-legs"])
def test_rays_from_many_positions_equal_those_of_each_position(name):
    world, rng = worlds.by_name(name), np.random.default_rng(3)
    places, directions = rng.uniform(-0.3, 0.4, (40, 2)), rng.uniform(-9, 9, 40)
    alone = [world.cast(p, [d])[0] for p, d in zip(places, directions, strict=True)]
    together = cast_each_ray(places, directions, world.walls, world.circles)
    np.testing.assert_allclose(together, alone, rtol=1e-9)


def test_where_nothing_is_nothing_is_seen():
    world = World([(1, -1, 1, 1)])
    ranges = cast_each_ray(np.zeros((2, 2)), np.array([0, np.pi]), world.walls, world.circles)
    assert ranges.tolist() == [1.0, np.inf]
    ranges = cast_each_ray(np.zeros((2, 2)), np.zeros(2), world.walls[:0], world.circles)
    assert ranges.min() == np.inf


def test_each_sample_is_taken_from_where_the_robot_is_just_then():
    robot = body_in(worlds.polygon(), pose=(0.1, 0.1, 0.5))
    robot.advance(50, 30, 0.0)
    times = 0.2 + 508e-6 * np.arange(1000)
    clockwise = np.linspace(0, 1800, 1000) % 360
    seen = MovingLidar(robot, np.random.default_rng(0), NOISELESS)(times, clockwise)
    poses = robot.pose_at(times)
    assert np.abs(np.diff(poses, axis=0)).min() > 0
    expected = [
        1000 * robot.world.cast(pose[:2], [pose[2] - np.radians(angle)])[0]
        for pose, angle in zip(poses, clockwise, strict=True)
    ]
    far = np.array(expected) > 200  # nearer than that it sees nothing
    np.testing.assert_allclose(seen[far], np.array(expected)[far], rtol=1e-9)
    assert not seen[~far].any()


def test_a_sample_s_noise_is_the_same_whenever_it_is_asked_for():
    is_visible = MovingLidar(body_in(worlds.polygon()), np.random.default_rng(2))
    times, angles = 5.0 + 127e-6 * np.arange(300), np.linspace(0, 359, 300)
    together = is_visible(times, angles)
    apart = np.concatenate(
        [is_visible(times[k : k + 7], angles[k : k + 7]) for k in range(0, 300, 7)]
    )
    np.testing.assert_array_equal(together, apart)


def test_noise_and_dropouts_are_the_scanner_s():
    robot, scanner = body_in(HALL), replace(RPLIDAR_A2, range_max=50.0, bearing_sigma=0.0)
    times, ahead = 1.0 + 508e-6 * np.arange(20_000), np.zeros(20_000)
    seen = MovingLidar(robot, np.random.default_rng(5), scanner)(times, ahead) / 1000
    kept = seen[seen > 0]
    assert abs(1 - len(kept) / len(seen) - scanner.dropouts) < 0.003
    assert abs(kept.mean() - 30) < 0.02
    assert 0.95 < kept.std() / scanner.model.sigma(30.0) < 1.05


@settings(max_examples=12)
@given(st.lists(st.floats(0.001, 0.2), min_size=1, max_size=8))
def test_a_body_follows_the_same_path_however_often_it_is_sampled(pauses):
    often, t = body_in(worlds.polygon()), 0.0
    often.advance(60, 40, 0.0)
    for pause in pauses:
        t += pause
        often.advance(60, 40, t)
        often.pose_at(np.array([t]))
    once = body_in(worlds.polygon())
    once.advance(60, 40, 0.0)
    once.advance(60, 40, t)
    times = np.array([0.5 * t, t])
    np.testing.assert_allclose(often.pose_at(times), once.pose_at(times), atol=1e-12)


def test_slip_is_what_the_counters_do_not_measure():
    measured, true = [], []
    for seed in range(12):
        robot = EmulatedRobot(
            HALL, np.random.default_rng(seed), robot=DifferentialDrive(tick=1e-6, slip=0.02)
        )
        robot.advance(100, 0, 0.0)
        robot.advance(100, 0, 2.5)
        measured.append(robot.counters())
        true.append(robot.pose[2])
    assert len(set(measured)) == 1
    # two wheels, 1 m each, over their base
    assert 0.4 < np.std(true) / (np.sqrt(2) * 0.02 / 0.3) < 1.8


def test_a_wall_stops_the_robot_before_its_rim_is_in_it_and_it_can_back_off():
    robot = body_in(worlds.polygon())
    robot.advance(100, 0, 0.0)
    robot.advance(100, 0, 30.0)
    x, y, _ = robot.pose
    nearest = robot.world.cast((x, y), np.linspace(-0.9, 0.9, 50)).min()
    assert 0.14 < nearest < 0.19
    robot.advance(-100, 0, 30.5)
    assert robot.pose[0] < x - 0.1


def test_the_infrared_sensors_measure_from_the_rim_up_to_their_range():
    eyes = body_in(worlds.polygon()).proximity()
    assert eyes.shape == (6,) and (eyes >= 0.1).all() and (eyes <= 0.8).all()
    assert (body_in(HALL).proximity() == 0.8).all()
