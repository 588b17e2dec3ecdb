"""Two scans of a room from before and after a motion, and the error of a match of them."""

import numpy as np
import pytest
from hypothesis import strategies as st

from slamlab.geometry import between, compose
from slamlab.scanmatching import match, point_to_line, point_to_point
from slamlab.simulation import worlds
from slamlab.simulation.range_scanners import RPLIDAR_A2

seeds = st.integers(0, 2**32 - 1)
PLACE, MOTION = np.array([0.2, 0.1, 0.3]), np.array([0.06, -0.05, 0.05])
OFF = np.array([0.02, -0.02, 0.02])  # of a first guess
MATCHERS = [match, point_to_line, point_to_point]
ALL = pytest.mark.parametrize("matcher", MATCHERS)


def looks(rng, lidar=RPLIDAR_A2, world="room"):
    """Scans from after a motion and from before it."""
    world = worlds.by_name(world)
    return lidar.scan(world, compose(PLACE, MOTION), rng), lidar.scan(world, PLACE, rng)


def clouds(seed):
    return [scan.points() for scan in looks(np.random.default_rng(seed))]


def pose_difference(a, b):
    """Distance [m] and turn [rad] between two poses."""
    x, y, turn = between(a, b)
    return np.hypot(x, y), abs(turn)


def error(found, true=MOTION):
    return pose_difference(true, found.pose)
