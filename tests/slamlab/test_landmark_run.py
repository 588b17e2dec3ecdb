"""Landmark worlds: repeatable, with the stated noise, and true models for the estimator."""

from dataclasses import replace

import numpy as np
import pytest

from slamlab import sources
from slamlab.geometry import between, compose, wrap
from slamlab.models.observation import g, h
from slamlab.sources.landmark_runs import CLEARANCE, LandmarkRun, Loop
from tests.slamlab.support import refuses

QUIET = Loop(v_sigma=0.0, omega_sigma=0.0, range_sigma=0.0, bearing_sigma=0.0)
DEFAULT = Loop()


def driven(seed=0, loop=DEFAULT):
    return LandmarkRun(loop, np.random.default_rng(seed))


def test_it_opens_by_its_name():
    source = sources.open("sim:landmarks", np.random.default_rng(4))
    np.testing.assert_array_equal(source.landmarks, driven(4).landmarks)


def test_iterating_twice_gives_the_same_readings_and_another_seed_others():
    source = driven(1)
    for a, b in zip(source, source, strict=True):
        np.testing.assert_array_equal(a.odometry, b.odometry)
        np.testing.assert_array_equal(a.observations.z, b.observations.z)
    assert not np.array_equal(list(driven(2))[1].odometry, list(source)[1].odometry)


def test_without_noise_odometry_is_the_truth_and_observations_give_the_landmarks():
    source, pose = driven(3, QUIET), np.zeros(3)
    for reading, true in zip(source, source.truth.poses, strict=True):
        pose = compose(pose, reading.odometry)
        np.testing.assert_allclose(between(true, pose), 0, atol=1e-9)
        seen = reading.observations
        np.testing.assert_allclose(g(true, seen.z), source.landmarks[seen.ids], atol=1e-9)


def test_the_robot_moves_round_the_loop_at_its_speed():
    source = driven(0, replace(QUIET, radius=3.0, v=0.6, steps=100, period=0.2))
    poses = source.truth.poses
    np.testing.assert_allclose(np.hypot(poses[:, 0], poses[:, 1] - 3.0), 3.0)
    chord = 2 * 3.0 * np.sin(0.6 * 0.2 / 3.0 / 2)
    np.testing.assert_allclose(np.hypot(*np.diff(poses[:, :2], axis=0).T), chord)


def test_landmarks_lie_off_the_loop_and_only_those_in_view_are_seen():
    loop = replace(QUIET, range_max=3.0, field_of_view=np.radians(120))
    source = driven(5, loop)
    off = np.abs(np.hypot(source.landmarks[:, 0], source.landmarks[:, 1] - loop.radius) - 4.0)
    assert off.min() >= CLEARANCE
    assert off.max() <= loop.spread
    for reading, pose in zip(source, source.truth.poses, strict=True):
        r, bearing = h(pose, source.landmarks).T
        visible = (r <= 3.0) & (np.abs(bearing) <= np.radians(60))
        np.testing.assert_array_equal(reading.observations.ids, np.flatnonzero(visible))


def test_errors_have_the_standard_deviation_of_the_robot_and_sensor_models():
    loop = Loop(steps=4000, range_max=20.0)
    source = driven(6, loop)
    _, *readings = source
    motion = np.array([reading.odometry for reading in readings])
    turn = loop.v * loop.period / loop.radius
    d = loop.v * loop.period
    turn_claimed = np.hypot(source.robot.turn_error * turn, source.robot.turn_per_metre * d)
    # 4000 draws give a standard deviation to 1.1 %
    assert np.std(motion[:, 2]) == pytest.approx(turn_claimed, rel=0.06)
    assert np.std(motion[:, 0]) == pytest.approx(source.robot.distance_error * d, rel=0.06)
    v = np.concatenate(
        [
            reading.observations.z - h(pose, source.landmarks[reading.observations.ids])
            for reading, pose in zip(source, source.truth.poses, strict=True)
        ]
    )
    assert np.std(v[:, 0]) == pytest.approx(source.sensor.range_sigma, rel=0.03)
    assert np.std(wrap(v[:, 1])) == pytest.approx(source.sensor.bearing_sigma, rel=0.03)
    assert np.abs(v[:, 0].mean()) < 0.01


def test_landmark_positions_do_not_depend_on_the_noise():
    np.testing.assert_array_equal(driven(7).landmarks, driven(7, QUIET).landmarks)


test_a_loop_that_is_invalid_is_refused = refuses(
    lambda wrong: Loop(**wrong),
    ({"landmarks": 0}, "landmarks, steps, .* must be positive"),
    ({"v": 0.0}, "must be positive"),
    ({"field_of_view": 120.0}, "radians"),
    ({"spread": 4.0}, "spread must be from 0.5 m to below the radius"),
    ({"range_sigma": -0.1}, "not be negative"),
)
