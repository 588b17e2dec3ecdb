"""The differential-drive simulator: arcs are exact, and odometry's errors follow its parameters."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from slamlab.estimators.ekf_slam import Q_arc
from slamlab.geometry import between, compose, inverse
from slamlab.simulation.differential_drive import (
    DifferentialDrive,
    Simulator,
    arc,
    follow_waypoints,
)
from tests.property_testing import assert_same_pose
from tests.slamlab.support import refuses

distances = st.floats(-2, 2)
FINE = DifferentialDrive(tick=1e-9)


def rng(seed=0):
    return np.random.default_rng(seed)


def driven(robot, commands, seed=0):
    """True and believed pose after driving commands (v, omega, seconds) from the origin."""
    simulator, believed = Simulator(robot, rng(seed)), np.zeros(3)
    for command in commands:
        believed = compose(believed, simulator.step(*command))
    return simulator.pose, believed


@given(distances, distances, st.floats(0.1, 1), st.integers(2, 9))
def test_an_arc_is_the_same_in_one_piece_or_in_many(left, right, base, pieces):
    pose = np.zeros(3)
    for _ in range(pieces):
        pose = compose(pose, arc(left / pieces, right / pieces, base))
    assert_same_pose(pose, arc(left, right, base))


@given(distances, distances, st.floats(0.1, 1))
def test_driving_an_arc_back_returns_to_the_start(left, right, base):
    assert_same_pose(compose(arc(left, right, base), arc(-left, -right, base)), np.zeros(3))
    assert_same_pose(arc(-left, -right, base), inverse(arc(left, right, base)))


def test_equal_wheels_drive_straight_and_opposite_ones_turn_on_the_spot():
    np.testing.assert_allclose(arc(0.7, 0.7, 0.3), [0.7, 0, 0])
    np.testing.assert_allclose(arc(-0.1, 0.1, 0.4), [0, 0, 0.5], atol=1e-15)


def test_an_arc_stays_on_its_circle():
    x, y, turn = arc(0.9, 1.1, 0.4)
    radius = 1.0 / 0.5  # way of the middle over turn
    assert turn == pytest.approx(0.5)
    assert np.hypot(x, y - radius) == pytest.approx(radius)


@given(st.lists(st.tuples(st.floats(-1, 1), st.floats(-2, 2), st.floats(0.1, 2)), max_size=6))
def test_without_errors_the_odometry_pose_equals_the_truth(commands):
    true, believed = driven(FINE, commands)
    assert_same_pose(true, believed, 1e-6)


def test_fractions_of_ticks_are_counted_later():
    robot = DifferentialDrive(tick=0.01)
    simulator, believed = Simulator(robot, rng()), 0.0
    for _ in range(1000):
        believed += simulator.step(0.0123, 0.0, 0.1)[0]
        assert -1e-9 <= simulator.pose[0] - believed < robot.tick + 1e-9


def test_in_mid_phase_a_path_of_whole_ticks_is_counted_whole_whatever_the_last_bit():
    simulator = Simulator(DifferentialDrive(tick=0.0002, phase=0.5), rng())
    for seconds in np.nextafter(0.1, [0.0, 1.0] * 500):
        assert simulator.step(0.1, 0.0, seconds)[0] == pytest.approx(0.01, abs=1e-12)


def test_odometry_is_a_motion_in_the_frame_of_the_pose_before():
    simulator = Simulator(FINE, rng(), pose=(3.0, -2.0, 2.4))
    for command in [(0.3, 0.5, 1.0), (0.2, -0.9, 2.0)]:
        before = simulator.pose
        assert_same_pose(simulator.step(*command), between(before, simulator.pose), 1e-6)


def test_wheels_of_unequal_size_bend_a_straight_drive():
    robot = replace(FINE, left_scale=0.99, right_scale=1.01)
    true, believed = driven(robot, [(1.0, 0.0, 3.0)])
    np.testing.assert_allclose(believed, [3, 0, 0], atol=1e-6)
    np.testing.assert_allclose(true, arc(3 * 0.99, 3 * 1.01, robot.base))


def test_a_wider_wheel_base_than_nominal_turns_less():
    true, believed = driven(replace(FINE, base_scale=1.05), [(0.0, 0.5, 2.0)])
    assert believed[2] == pytest.approx(1.0)
    assert true[2] == pytest.approx(1.0 / 1.05)


@pytest.mark.parametrize("pieces", [1, 3, 10])
def test_slip_gives_the_same_variance_however_the_path_is_divided(pieces):
    robot = replace(FINE, slip=0.01)
    simulator = Simulator(robot, rng(3))
    turns = []
    for _ in range(800):
        simulator.pose = np.zeros(3)
        for _ in range(pieces):
            simulator.step(2.0 / pieces, 0.0, 1.0)
        turns.append(simulator.pose[2])
    modelled = 0.01 * np.sqrt(2.0) * np.sqrt(2) / robot.base
    assert np.std(turns) == pytest.approx(modelled, rel=0.12)
    assert abs(np.mean(turns)) < 5 * modelled / np.sqrt(800)


def test_encoders_do_not_measure_slip_and_a_robot_at_rest_does_not_slip():
    robot = replace(FINE, slip=0.1)
    true, believed = driven(robot, [(1.0, 0.0, 1.0)])
    np.testing.assert_allclose(believed, [1, 0, 0], atol=1e-6)
    assert abs(true[0] - 1) > 1e-4
    np.testing.assert_array_equal(driven(robot, [(0.0, 0.0, 5.0)])[0], np.zeros(3))


@pytest.mark.parametrize(("way", "turn"), [(0.2, 0.0), (0.0, 0.4), (0.15, -0.3)])
def test_the_model_has_the_standard_deviation_that_the_robot_shows(way, turn):
    robot = replace(FINE, slip=0.01)
    motion = arc(way - turn * robot.base / 2, way + turn * robot.base / 2, robot.base)
    simulator, ends = Simulator(robot, rng(5)), []
    for _ in range(4000):
        simulator.pose = np.zeros(3)
        simulator.step(way, turn, 1.0)
        ends.append(simulator.pose - motion)
    Q = Q_arc(np.zeros(3), motion, robot.model)
    found, unit = np.cov(np.array(ends).T), np.sqrt(np.diag(Q)) + 1e-3
    np.testing.assert_allclose(found / np.outer(unit, unit), Q / np.outer(unit, unit), atol=0.09)


def test_constant_errors_of_the_scales_are_reported_as_deviations():
    modelled = replace(FINE, left_scale=0.98, right_scale=1.0, base_scale=1.03).model
    assert modelled.distance_error == pytest.approx(0.01)
    assert modelled.turn_error == pytest.approx(np.hypot(0.01, 0.03))
    assert modelled.turn_per_metre == pytest.approx(0.02 / FINE.base)


def test_the_same_generator_gives_the_same_run():
    robot = replace(FINE, slip=0.05)
    commands = [(0.4, 0.3, 1.0)] * 5
    np.testing.assert_array_equal(driven(robot, commands, 1)[0], driven(robot, commands, 1)[0])
    assert np.any(driven(robot, commands, 1)[0] != driven(robot, commands, 2)[0])


def test_waypoint_following_reaches_every_waypoint_with_any_odometry():
    robot = DifferentialDrive(left_scale=0.97, right_scale=1.03, base_scale=1.1, slip=0.02)
    simulator = Simulator(robot, rng(4))
    waypoints = np.array([(1.0, 0.0), (1.0, 2.0), (-1.0, 1.0), (0.0, 0.0)])
    track = np.array([simulator.pose for _ in follow_waypoints(simulator, waypoints)])
    for waypoint in waypoints:
        assert np.hypot(*(track[:, :2] - waypoint).T).min() < 0.05


def test_waypoint_following_respects_the_maximum_speeds():
    simulator = Simulator(FINE, rng())
    path = follow_waypoints(simulator, [(1.0, 1.0), (-2.0, 0.5)], v=0.3, omega=0.7, period=0.4)
    commands = np.array([command for command, _ in path])
    assert commands[:, 0].min() >= 0
    assert commands[:, 0].max() <= 0.3
    assert np.abs(commands[:, 1]).max() <= 0.7


test_a_robot_that_is_invalid_is_refused = refuses(
    lambda wrong: DifferentialDrive(**wrong),
    ({"base": 0.0}, "must be positive"),
    ({"right_scale": -1.0}, "must be positive"),
    ({"slip": -0.1}, "slip"),
    ({"phase": 1.0}, "phase"),
)
