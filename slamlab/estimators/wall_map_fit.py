"""Fit of a scan to a map of walls: distances from points to walls, and beams through walls."""

import numpy as np

from slamlab.estimators.wall_merging import ends_of
from slamlab.simulation.worlds.ray_casting import cast

BLUR = 0.02  # standard deviation of the map and of the discretised poses [m]
MAX_ERROR = 3.0  # largest distance of a hit from a wall that explains it [σ]


def map_segments(filter, extents):
    """Return observed segments (k, 4) of walls: ρ [m], α [rad], start and end on the line [m]."""
    lines = zip(filter.ids, filter.landmarks(), strict=True)
    return np.reshape([[*line, *part] for i, line in lines for part in extents[i]], (-1, 4))


def distances_to_walls(poses, points, segments):
    """Return the distances (n, m) [m] of points (m, 2), observed from poses (n, 3), to the nearest
    of the ``segments`` (k, 4) that faces the robot; infinite if no segment does."""
    c, s = np.cos(poses[:, 2:]), np.sin(poses[:, 2:])
    x = poses[:, :1] + c * points[:, 0] - s * points[:, 1]
    y = poses[:, 1:2] + s * points[:, 0] + c * points[:, 1]
    nearest = np.full(x.shape, np.inf)
    for rho, alpha, low, high in segments:
        c, s = np.cos(alpha), np.sin(alpha)
        across, along = c * x + s * y - rho, c * y - s * x
        beyond = np.maximum(np.maximum(low - along, along - high), 0)
        squared = across**2 + beyond**2
        squared[poses[:, :2] @ [c, s] > rho] = np.inf
        np.minimum(nearest, squared, out=nearest)
    return np.sqrt(nearest)


def fraction_through_walls(pose, scan, segments, sensor):
    """Return the fraction of a scan's beams that would have passed through a wall."""
    lines = segments[:, :2]
    facing = pose[0] * np.cos(lines[:, 1]) + pose[1] * np.sin(lines[:, 1]) < lines[:, 0]
    walls = [ends_of(line, part) for line, part in zip(lines, segments[:, 2:], strict=True)]
    walls = np.reshape(walls, (-1, 4))[facing]
    expected = cast(pose[:2], scan.angles + pose[2], walls)
    near = expected < scan.range_max
    # a beam without a return has the maximum range
    ranges, expected = np.where(scan.valid, scan.ranges, scan.range_max)[near], expected[near]
    through = ranges > expected + BLUR + MAX_ERROR * sensor.sigma(expected)
    return np.count_nonzero(through) / len(near)
