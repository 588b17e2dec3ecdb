"""How well a scan fits a map of walls, from many poses: what walls explain, what they contradict.

Hits are explained by a wall that they lie on; beams that would have gone through a wall contradict
the map. Seen from where the robot truly is there are few of these, whatever is new to the map.
"""

import numpy as np

from slamlab.estimators.wall_merging import ends_of
from slamlab.worlds.ray_casting import cast

BLUR = 0.02  # of the map and of poses that stand for all near them [m]
MAX_ERROR = 3.0  # of a hit from a wall that explains it [σ]


def map_pieces(filter, extents):
    """(k, 4) the walls of a map as far as seen: ρ [m], α [rad], from and to along the line [m]."""
    lines = zip(filter.ids, filter.landmarks(), strict=True)
    return np.reshape([[*line, *part] for i, line in lines for part in extents[i]], (-1, 4))


def wall_errors(poses, points, pieces):
    """Distances of a scan's points to the nearest wall that faces the robot.

    Parameters
    ----------
    poses : (n, 3) [m, m, rad]
    points : (m, 2) in the robot's frame [m]
    pieces : (k, 4) of walls, see :func:`map_pieces`

    Returns
    -------
    (n, m) [m]; infinite where no wall faces the robot
    """
    c, s = np.cos(poses[:, 2:]), np.sin(poses[:, 2:])
    x = poses[:, :1] + c * points[:, 0] - s * points[:, 1]
    y = poses[:, 1:2] + s * points[:, 0] + c * points[:, 1]
    nearest = np.full(x.shape, np.inf)
    for rho, alpha, low, high in pieces:
        c, s = np.cos(alpha), np.sin(alpha)
        across, along = c * x + s * y - rho, c * y - s * x
        beyond = np.maximum(np.maximum(low - along, along - high), 0)
        squared = across**2 + beyond**2
        squared[poses[:, :2] @ [c, s] > rho] = np.inf
        np.minimum(nearest, squared, out=nearest)
    return np.sqrt(nearest)


def share_through_walls(pose, scan, pieces, sensor):
    """Share of a scan's beams that would have gone through a wall of the map that faces the robot.

    Parameters
    ----------
    pose : (3,) [m, m, rad]
    scan : Scan
    pieces : (k, 4) of walls, see :func:`map_pieces`
    sensor : SensorModel

    Returns
    -------
    float, from 0 to 1
    """
    lines = pieces[:, :2]
    facing = pose[0] * np.cos(lines[:, 1]) + pose[1] * np.sin(lines[:, 1]) < lines[:, 0]
    walls = [ends_of(line, part) for line, part in zip(lines, pieces[:, 2:], strict=True)]
    walls = np.reshape(walls, (-1, 4))[facing]
    expected = cast(pose[:2], scan.angles + pose[2], walls)
    near = expected < scan.range_max
    # what came from nowhere was as far away as the sensor sees
    ranges, expected = np.where(scan.valid, scan.ranges, scan.range_max)[near], expected[near]
    through = ranges > expected + BLUR + MAX_ERROR * sensor.sigma(expected)
    return np.count_nonzero(through) / len(near)
