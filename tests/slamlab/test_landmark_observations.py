"""Landmark observations: corners lie where corners are, with errors as in their R."""

import numpy as np
import pytest

from slamlab.estimators.landmark_observations import (
    CORNER_REACH,
    SHORT_RANGE_RANSAC,
    DataAssociation,
    measurement_noise,
    observed_landmarks,
)
from slamlab.evaluation import nees
from slamlab.geometry import wrap
from slamlab.landmarks.corners import corners
from slamlab.landmarks.ransac import Ransac, lines
from slamlab.models.observation import g, h
from slamlab.readings import Observations, Reading
from slamlab.simulation.range_scanners import RPLIDAR_A2
from slamlab.simulation.worlds import box
from slamlab.simulation.worlds.world import World
from slamlab.sources.arena_runs import ArenaRun

ENOUGH = 5  # readings on each of its walls: then a corner ought to be found


def RNG(seed=0):
    return np.random.default_rng(seed)


def corners_of(world):
    """(k, 2) true corners, and for each the (2,) rows of its walls."""
    ends, at = np.unique(world.walls.reshape(-1, 2).round(9), axis=0, return_inverse=True)
    return ends, [np.flatnonzero(at.reshape(-1) == k) // 2 for k in range(len(ends))]


def visible_corners(world, scanner, pose):
    """Corners of which enough of both walls is within reach."""
    beams = pose[2] + scanner.angles
    r = world.cast(pose[:2], beams)
    hits = pose[:2] + r[:, None] * np.column_stack([np.cos(beams), np.sin(beams)])
    start, way = world.walls[:, :2], world.walls[:, 2:] - world.walls[:, :2]
    off = hits[:, None] - start
    along = np.clip(np.sum(off * way, axis=2) / np.sum(way**2, axis=1), 0, 1)
    wall = np.hypot(*(off - along[..., None] * way).transpose(2, 0, 1)).argmin(axis=1)
    count = np.bincount(wall[r < scanner.range_max], minlength=len(way))
    ends, walls = corners_of(world)
    near = h(pose, ends)[:, 0] < scanner.range_max
    return {k for k, rows in enumerate(walls) if near[k] and count[rows].min() >= ENOUGH}


@pytest.fixture(scope="module")
def found_corners():
    """Three laps: errors and R of corners, and counts of false, found and visible ones."""
    errors, R, false, found, ought = [], [], 0, 0, 0
    for seed in range(3):
        source, rng = ArenaRun(RNG(seed), laps=1), RNG(seed)
        ends, _ = corners_of(source.world)
        for reading, pose in zip(source, source.truth.poses, strict=True):
            got, sees = observed_landmarks(reading, source.sensor, rng), set()
            for z, covariance in zip(got.z, got.R, strict=True):
                off = np.hypot(*(ends - g(pose, z)).T)
                k = int(off.argmin())
                if off[k] > 0.05:
                    false += 1
                    continue
                error = z - h(pose, ends[k])
                errors.append([error[0], wrap(error[1])])
                R.append(covariance)
                sees.add(k)
            due = visible_corners(source.world, source.scanner, pose)
            ought, found = ought + len(due), found + len(due & sees)
    return np.array(errors), np.array(R), false, found, ought


@pytest.mark.slow
def test_every_found_corner_is_one_and_half_of_the_visible_ones_are_found(found_corners):
    errors, _, false, found, ought = found_corners
    assert len(errors) > 100
    assert false <= 0.02 * len(errors)
    assert 0.5 * ought < found <= ought


def test_corners_lie_where_corners_are_and_errors_match_R(found_corners):
    errors, R, *_ = found_corners
    scatter = errors.std(axis=0) / np.sqrt(len(errors))
    assert np.all(np.abs(errors.mean(axis=0)) < 4 * scatter + [0.002, 0.005])
    each = nees(errors, R)
    assert 0.5 < each.mean() < 3  # 2 if R were exact; within 3 cm it is larger than the noise is
    assert np.mean(each > 13.8) < 0.02


def test_R_is_symmetric_to_the_last_bit(found_corners):
    np.testing.assert_array_equal(found_corners[1], found_corners[1].transpose(0, 2, 1))


def test_a_long_range_sensor_has_the_usual_corners():
    room, pose = World(box((0, 0), (4.0, 3.0))), np.zeros(3)
    reading = Reading(0.0, scan=RPLIDAR_A2.scan(room, pose, RNG(1)))
    found = observed_landmarks(reading, RPLIDAR_A2.model, RNG(2))
    usual = corners(lines(reading.scan, RPLIDAR_A2.model, RNG(2)))
    np.testing.assert_array_equal(found.z, [corner.z for corner in usual])
    assert len(found.z) == 4 and np.all(found.ids == -1)
    assert found.bisectors is None  # it sees thin walls from either side


def test_parameters_of_ones_own_are_used():
    source = ArenaRun(RNG(1), laps=1)
    deaf = Ransac(window=60, min_inliers=60)
    assert not any(len(observed_landmarks(r, source.sensor, RNG(), deaf).z) for r in source)


def test_named_observations_come_first_and_nothing_gives_nothing():
    sensor = RPLIDAR_A2.model
    observed = Reading(0.0, observations=Observations(np.array([[2.0, 0.1]]), np.array([7])))
    found = observed_landmarks(observed, sensor, RNG())
    assert found.ids.tolist() == [7] and found.R.shape == (1, 2, 2)
    np.testing.assert_array_equal(found.R, measurement_noise(sensor, [2.0]))
    own = np.diag([0.04, 0.01])[None]
    observed = Reading(0.0, observations=Observations(found.z, found.ids, own))
    found = observed_landmarks(observed, sensor, RNG())
    np.testing.assert_array_equal(found.R, own)
    nothing = observed_landmarks(Reading(0.0), sensor, RNG())
    assert nothing.z.shape == (0, 2) and nothing.R.shape == (0, 2, 2) and len(nothing.ids) == 0


def test_ids_are_the_sources_else_a_known_landmarks_else_new_and_negative():
    association = DataAssociation()
    found = Observations(np.ones((5, 2)), np.array([4, -1, -1, -1, 4]), np.ones((5, 2, 2)))
    pair = {0: 1}, [2]  # of the three without a name: the first is known, the second is ambiguous
    assert association.associate(found, [10, 11], lambda nameless: pair) == {4: 0, 11: 1, -1: 3}
    assert association.ambiguous == 2
    assert association.associate(found, [10, 11], lambda nameless: ({}, [0])) == {4: 0, -2: 1}


def corners_from(world, pose, scanner=RPLIDAR_A2):
    """Places z, bisectors and whether convex, of the corners seen from a pose."""
    scan = scanner.scan(world, np.array(pose), RNG(1))
    found = corners(lines(scan, scanner.model, RNG(2)))
    return (np.array([getattr(c, name) for c in found]) for name in ("z", "bisector", "convex"))


@pytest.mark.parametrize("theta", [0.0, 0.7, 3.0, -2.0])
def test_a_rooms_corners_are_concave_and_open_to_its_middle(theta):
    pose = np.array([0.3, -0.2, theta])
    z, bisectors, convex = corners_from(World(box((0, 0), (4.0, 3.0))), pose)
    assert len(z) == 4 and not convex.any()
    quadrants = np.sign(g(pose, z))
    to_middle = np.arctan2(-quadrants[:, 1], -quadrants[:, 0])
    assert np.abs(wrap(bisectors + theta - to_middle)).max() < 0.05


def test_a_boxs_corners_are_convex_and_open_into_the_box():
    cube, pose = World(box((3.0, 0.0), (1.0, 1.0), np.pi / 4)), (0.0, 0.0, 0.5)
    _, (bisector,), (convex,) = corners_from(cube, pose)
    assert convex and abs(wrap(bisector + 0.5)) < 0.05  # away from the robot


def test_corners_of_a_short_range_sensor_get_a_larger_R_than_their_lines_give():
    source = ArenaRun(RNG(1), laps=1)
    near = observed_with_corner = None
    for reading in source:
        near = observed_landmarks(reading, source.sensor, RNG(2))
        if len(near.z):
            pieces = lines(reading.scan, source.sensor, RNG(2), SHORT_RANGE_RANSAC)
            observed_with_corner = corners(pieces, reach=CORNER_REACH)
            break
    np.testing.assert_allclose(near.R[0], 2 * observed_with_corner[0].R)
