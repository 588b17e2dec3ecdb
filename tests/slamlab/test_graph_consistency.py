"""Graph SLAM: loops' covariances against the truth, and odometry errors that it learns."""

from dataclasses import replace

import numpy as np
import pytest

from slamlab import sources
from slamlab.estimators.graph_slam import GraphSlam
from slamlab.geometry import between, compose, wrap
from slamlab.posegraph import edge_error
from slamlab.readings import Scan
from slamlab.scanmatching import match
from slamlab.scanmatching.correlated_errors import CorrelatedError
from slamlab.simulation import worlds
from slamlab.simulation.range_scanners import RPLIDAR_A2

TURN_TIME = 0.1  # of a lidar whose scans nobody deskews [s]
PERIOD = 0.5  # between the readings of a tour [s]


def blurred(source):
    """Readings of a tour whose beams are cast one after another, from a robot that moves on."""
    lidar, truth, readings = source.lidar, source.truth.poses, list(source)
    share = (np.arange(lidar.beams) / lidar.beams - 0.5) * TURN_TIME / PERIOD
    parts = np.array_split(np.arange(lidar.beams), 40)
    for i in range(1, len(readings)):
        motion, rng = between(truth[i - 1], truth[i]), np.random.default_rng([11, i])
        ranges = np.empty(lidar.beams)
        for part in parts:
            x, y, heading = compose(truth[i], motion * share[part[len(part) // 2]])
            ranges[part] = source.world.cast((x, y), heading + lidar.angles[part])
        ranges[~np.isfinite(ranges)] = np.nan
        ranges += lidar.model.sigma(ranges) * rng.standard_normal(lidar.beams)
        scan = Scan(lidar.angles, ranges, lidar.range_max, lidar.range_min)
        readings[i] = replace(readings[i], scan=scan)
    return readings


def loops_nees(slam, truth):
    """NEES of each loop edge against the true poses."""
    true, found = truth[np.flatnonzero(np.diff(slam.anchors, prepend=-1) > 0)], []
    for edge in slam.graph.edges:
        if edge.robust:
            e = edge_error.error(true[edge.i], true[edge.j], edge.measured)
            found.append(e @ edge.information @ e)
    return found


@pytest.mark.slow
@pytest.mark.parametrize("change", [list, blurred])
def test_loop_errors_match_their_covariance_also_where_scans_are_blurred(change):
    # 0.02 with the errors in common taken for a share of the noise, hundreds without any
    nees = []
    for name, seed in (("corridor", 31), ("twins", 32), ("room", 33)):
        source = sources.open(f"sim:{name}", np.random.default_rng(seed))
        slam = GraphSlam(source.robot)
        for reading in change(source):
            slam.step(reading)
        nees += loops_nees(slam, source.truth.poses)
    assert len(nees) > 60
    assert 1.5 < np.mean(nees) < 6


@pytest.mark.parametrize("common", [0.0, 0.02])
def test_residuals_show_what_walls_are_off_by_in_common_and_no_noise(common):
    world, rng, seen = worlds.room(), np.random.default_rng(3), CorrelatedError()
    for _ in range(30):
        places = [np.array([*rng.uniform(-0.3, 0.3, 2), rng.uniform(-3, 3)]) for _ in range(2)]
        clouds = []
        for place in places:
            scan = RPLIDAR_A2.scan(world, place, rng)
            # a range that is off as slowly as the bearing changes: no motion looks like that
            off = common * np.sqrt(2) * np.sin(4 * scan.angles + rng.uniform(-3, 3))
            clouds.append(replace(scan, ranges=scan.ranges + off).points())
        found = match(*clouds, between(places[1], places[0]))
        found.add_residuals(seen)
    if common:
        assert common < seen.sigma < 2 * common  # of two scans: √2 times one's
    else:
        assert seen.sigma < 0.001


def test_wheels_that_err_all_the_time_are_calibrated_by_the_scans():
    source = sources.open("sim:situation-1", np.random.default_rng(5))
    slam = GraphSlam(source.robot)
    for reading in source:
        x, y, turn = reading.odometry
        measured = np.array([0.94 * x, 0.94 * y, wrap(1.05 * turn + 0.03 * x)])
        slam.step(replace(reading, odometry=measured))
    length, turn, per_metre = slam.calibration.gains
    assert length == pytest.approx(1 / 0.94 - 1, abs=0.02)
    assert turn == pytest.approx(1 / 1.05 - 1, abs=0.02)
    assert per_metre == pytest.approx(-0.03 / 0.94, abs=0.02)


def test_wheels_without_such_errors_stay_as_they_are():
    source = sources.open("sim:situation-1", np.random.default_rng(6))
    slam = GraphSlam(source.robot)
    for reading in source:
        slam.step(reading)
    assert np.abs(slam.calibration.gains).max() < 0.02
