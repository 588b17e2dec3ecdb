"""A robot that drives through a known room, and the law of a log that is read rightly."""

from typing import NamedTuple

import numpy as np

from slamlab.geometry import compose, transform
from slamlab.simulation.worlds import ray_casting

CENTRE = np.zeros(3)


class Drive(NamedTuple):
    """Times (n,) [s] and true poses (n, 3) of a robot."""

    times: np.ndarray
    poses: np.ndarray

    def at(self, times):
        columns = [*self.poses[:, :2].T, np.unwrap(self.poses[:, 2])]
        return np.stack([np.interp(times, self.times, column) for column in columns], axis=-1)


def closed(corners):
    """Walls (n, 4) of a closed polygon."""
    return np.concatenate([corners, np.roll(corners, -1, axis=0)], axis=1)


# an L-shaped room with a cupboard: neither turned nor mirrored is it the same
ROOM = np.array([[-3, -2], [6, -2], [6, 4], [2, 4], [2, 2.5], [-3, 2.5]], dtype=float)
CUPBOARD = np.array([[4, 0.5], [5, 0.5], [5, 1.3], [4, 1.3]])
WALLS = np.concatenate([closed(ROOM), closed(CUPBOARD)])


def drive(count=40, step=0.25, begin=1000.0):
    """A drive ahead with turns to either side, 0.3 m/s and up to 35°/s."""
    times = begin + step * np.arange(count)
    turns = 0.6 * np.sin(2 * np.pi * np.arange(count) / 17)
    poses = [np.array([-1.0, -1.0, 0.2])]
    for turn in turns[:-1]:
        poses.append(compose(poses[-1], [0.3 * step, 0.0, turn * step]))
    return Drive(times, np.array(poses))


def ranges(pose, angles):
    """Exact ranges (n,) [m] of a laser at a pose, along its angles (n,)."""
    return ray_casting.cast(pose[:2], pose[2] + np.asarray(angles), WALLS)


def distances_to_walls(points, walls=WALLS):
    """Distances (n,) [m] of points (n, 2) to the nearest of walls (k, 4)."""
    a, b = walls[:, :2], walls[:, 2:]
    along = b - a
    share = np.einsum("nwk,wk->nw", points[:, None] - a, along) / (along**2).sum(axis=1)
    nearest = a + np.clip(share, 0, 1)[..., None] * along
    return np.linalg.norm(points[:, None] - nearest, axis=2).min(axis=1)


def assert_read_rightly(source, true, mount=CENTRE, count=None, beams=None, tolerance=0.03):
    """Whether every reading's scan lies on the walls, seen from where its odometry has the laser.

    Without odometry: from where the laser was at its time.
    """
    readings = list(source)
    assert len(readings) == len(source) == (len(true.times) if count is None else count)
    assert {r.odometry is None for r in readings} == {not source.has_odometry}
    pose = compose(true.at(readings[0].time), mount)
    for reading in readings:
        true_pose = compose(true.at(reading.time), mount)
        pose = compose(pose, reading.odometry) if source.has_odometry else true_pose
        assert np.allclose(pose[:2], true_pose[:2], atol=tolerance)
        points = transform(pose, reading.scan.points())
        assert len(points) >= 0.9 * (len(reading.scan.ranges) if beams is None else beams)
        assert distances_to_walls(points).max() < tolerance
