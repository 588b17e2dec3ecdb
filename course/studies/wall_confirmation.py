"""Track management of walls (tentative, confirmed), with known poses, without a filter (lesson 08).

The parameters are Smolec's minimum number of observations and maximum number of misses.
"""

import numpy as np

from course.studies.line_extraction_recall import NEAR, on_wall
from slamlab import models
from slamlab.geometry import transform, wrap
from slamlab.landmarks.ransac import lines
from slamlab.landmarks.track_management import TentativeWall, TrackManager, extent
from slamlab.sources.simulated_robot import THESIS_LIDAR

RADIUS = 0.5  # of the loop that is driven [m]


def observed_walls(world, ransac=None, scans=40, seed=13):
    """Return the walls observed on a small loop, transformed by the true poses: a list of (line
    (2,), ends (2, 2)) for each scan."""
    rng, seen = np.random.default_rng(seed), []
    for phi in 2 * np.pi * np.arange(scans) / scans:
        pose = np.array([RADIUS * np.sin(phi), -RADIUS * np.cos(phi), wrap(phi)])
        found = lines(THESIS_LIDAR.scan(world, pose, rng), THESIS_LIDAR.model, rng, ransac)
        seen.append([(models.g_line(pose, line.z), transform(pose, line.ends)) for line in found])
    return seen


def confirmed_walls(seen, needed=1, lives=3, within_scan=True):
    """Return the walls that are confirmed after ``needed`` observations.

    A tentative wall is deleted after ``lives`` scans without an observation. If ``within_scan``,
    new walls of one scan are compared with each other.
    """
    tracks, in_map = TrackManager(needed, lives), []
    for scan in seen:
        known = list(in_map)
        new = [seen for seen in scan if not any(wall.fits(*seen) for wall in known)]
        for (line, ends), due in zip(new, tracks.update(new), strict=True):
            if due and not (within_scan and any(wall.fits(line, ends) for wall in in_map)):
                in_map.append(TentativeWall(line, extent(line, ends), 1, 1))
    return in_map


def ends(wall):
    """Return the end points of a wall of the map, (2, 2) [m]."""
    rho, alpha = wall.line
    c, s = np.cos(alpha), np.sin(alpha)
    return np.array([rho * c, rho * s]) + np.outer(wall.extent, [-s, c])


def duplicate_walls(walls):
    """Return a mask (n,) of the walls of a map that duplicate an earlier wall."""
    pairs = [(wall.line, ends(wall)) for wall in walls]
    return np.array([any(w.fits(*p) for w in walls[:i]) for i, p in enumerate(pairs)], dtype=bool)


def false_walls(world, walls):
    """Return a mask (n,) of the false walls of a map: their midpoint is on no wall of the world."""
    on = []
    for wall in walls:
        u = np.array([-np.sin(wall.line[1]), np.cos(wall.line[1])])
        on.append(on_wall(world.walls, ends(wall).mean(axis=0)[None], u, beyond=NEAR).any())
    return ~np.array(on, dtype=bool)
