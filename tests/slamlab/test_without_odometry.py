"""A lidar without a robot: no odometry, which is not odometry that stands still."""

from dataclasses import replace
from itertools import islice, pairwise

import numpy as np
import pytest

from slamlab import estimators, sources
from slamlab.deskewing import deskew_by_velocity
from slamlab.estimators.factory import WITHOUT_ODOMETRY
from slamlab.estimators.laser_odometry import LaserOdometry
from slamlab.geometry import between, compose
from slamlab.readings import Reading, Scan
from slamlab.simulation import RPLIDAR_A2, worlds
from tests.slamlab.support import Given

WALK = "sim:flat-carried"
SECONDS = 10


@pytest.fixture(scope="module")
def walk():
    """The first seconds of a walk, with the true poses."""
    source = sources.open(WALK)
    readings = list(islice(source, int(SECONDS * source.lidar.rate)))
    return source, readings, source.truth.poses[: len(readings)]


def error_at_end(poses, truth):
    return between(between(truth[0], truth[-1]), between(poses[0], poses[-1]))


@pytest.mark.parametrize("name", WITHOUT_ODOMETRY)
def test_scans_alone_are_matched_and_deskewed(walk, name):
    source, readings, truth = walk
    slam = estimators.make(name, source)
    for reading in readings:
        slam.step(reading)
    way = np.hypot(*np.diff(truth[:, :2], axis=0).T).sum()
    x, y, turn = error_at_end(slam.trajectory().poses, truth)
    assert way > 3
    assert np.hypot(x, y) < 0.01 * way and abs(turn) < np.radians(1)


def test_a_run_without_odometry_has_no_naive_trajectory(walk):
    source, _, _ = walk
    short = list(islice(source, 20))
    few = Given(short, source, has_odometry=False)
    result = estimators.run(few, estimators.make("icp", few))
    assert result.naive is None and result.frames == len(short)
    assert all(layer.name != "naive" for layer in result.estimator.layers())


def test_odometry_that_stands_still_is_not_none(walk):
    _, readings, _ = walk
    still = [replace(reading, odometry=np.zeros(3)) for reading in readings[:30]]
    slam = estimators.IcpSlam()
    for reading in still:
        slam.step(reading)
    assert slam.has_odometry and not slam.without_odometry


def scans_along(poses, period=0.1, beams=400):
    """Readings of a lidar that moves evenly from pose to pose while it scans, without noise."""
    world, share = worlds.by_name("room"), (np.arange(beams) + 1) / beams
    scanner = replace(RPLIDAR_A2, beams=beams)
    for k, (begin, end) in enumerate(pairwise(poses)):
        where = compose(begin, share[:, None] * between(begin, end))
        angles = -2 * np.pi * share
        ranges = np.array(
            [world.cast(pose[:2], pose[2:] + a)[0] for pose, a in zip(where, angles, strict=True)]
        )
        times = (share - 1) * period
        scan = Scan(angles, ranges, scanner.range_max, scanner.range_min, times)
        yield Reading(period * (k + 1), scan=scan)


def test_a_scan_deskewed_by_its_true_motion_is_that_from_its_end():
    poses = np.array([[0.0, 0, 0], [0.1, 0.02, 0.15]])
    (reading,) = scans_along(poses)
    straight = deskew_by_velocity(reading.scan, between(*poses), 0.1)
    seen = worlds.by_name("room").cast(poses[1, :2], poses[1, 2] + straight.angles)
    near = np.abs(seen - straight.ranges)
    assert np.quantile(near, 0.9) < 1e-4  # at edges a beam passes or does not
    assert np.quantile(np.abs(seen - reading.scan.ranges), 0.9) > 0.05


def test_laser_odometry_follows_steady_motion_to_a_millimetre_a_scan():
    step = np.array([0.08, 0.0, 0.05])
    poses = [np.zeros(3)]
    for _ in range(12):
        poses.append(compose(poses[-1], step))
    odometry, found = LaserOdometry(), []
    for reading in scans_along(np.array(poses)):
        found.append(odometry(reading, 0.1).odometry)
    off = np.array(found[4:]) - step
    assert np.abs(off).max() < 2e-3
    assert odometry.unmatched == 0
