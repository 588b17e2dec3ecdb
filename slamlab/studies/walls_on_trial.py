"""Which walls enter a map: poses known, N sightings to be confirmed, lives to survive unseen.

What lesson 08 shows of Smolec's N and lives, without a filter in the way.
"""

import numpy as np

from slamlab import models
from slamlab.geometry import transform, wrap
from slamlab.landmarks.ransac import lines
from slamlab.landmarks.tentative_walls import TentativeWall, TentativeWalls, extent
from slamlab.sources.simulated_robot import THESIS_LIDAR
from slamlab.studies.found_walls import NEAR, lie_on

RADIUS = 0.5  # of the loop that is driven [m]


def sightings(world, ransac=None, scans=40, seed=13):
    """Walls seen from a small loop, placed in the world by the true pose.

    Parameters
    ----------
    world : World
    ransac : Ransac, its defaults when None
    scans, seed : int

    Returns
    -------
    list, a scan each, of lists of (line (2,), ends (2, 2)) in the world's frame
    """
    rng, seen = np.random.default_rng(seed), []
    for phi in 2 * np.pi * np.arange(scans) / scans:
        pose = np.array([RADIUS * np.sin(phi), -RADIUS * np.cos(phi), wrap(phi)])
        found = lines(THESIS_LIDAR.scan(world, pose, rng), THESIS_LIDAR.model, rng, ransac)
        seen.append([(models.g_line(pose, line.z), transform(pose, line.ends)) for line in found])
    return seen


def entered(seen, needed=1, lives=3, within_scan=True):
    """The walls that enter a map; each waits until it was seen often enough.

    Parameters
    ----------
    seen : list, as ``sightings`` gives
    needed : int, sightings that confirm a wall
    lives : int, scans that it survives unseen while it waits
    within_scan : bool, whether new walls of one scan are compared with each other

    Returns
    -------
    list of TentativeWall
    """
    trial, in_map = TentativeWalls(needed, lives), []
    for scan in seen:
        known = list(in_map)
        new = [sight for sight in scan if not any(wall.fits(*sight) for wall in known)]
        for (line, ends), due in zip(new, trial.sight(new), strict=True):
            if due and not (within_scan and any(wall.fits(line, ends) for wall in in_map)):
                in_map.append(TentativeWall(line, extent(line, ends), 1, 1))
    return in_map


def ends(wall):
    """Where a wall of the map begins and ends.

    Parameters
    ----------
    wall : TentativeWall

    Returns
    -------
    (2, 2) points [m]
    """
    rho, alpha = wall.line
    c, s = np.cos(alpha), np.sin(alpha)
    return np.array([rho * c, rho * s]) + np.outer(wall.extent, [-s, c])


def repeated(walls):
    """Which walls of a map repeat one that came in before them.

    Parameters
    ----------
    walls : list of TentativeWall

    Returns
    -------
    (n,) bool
    """
    pairs = [(wall.line, ends(wall)) for wall in walls]
    return np.array([any(w.fits(*p) for w in walls[:i]) for i, p in enumerate(pairs)], dtype=bool)


def false(world, walls):
    """Which walls of a map are none of the world: their middle lies on no wall.

    Parameters
    ----------
    world : World
    walls : list of TentativeWall

    Returns
    -------
    (n,) bool
    """
    on = []
    for wall in walls:
        way = np.array([-np.sin(wall.line[1]), np.cos(wall.line[1])])
        on.append(lie_on(world.walls, ends(wall).mean(axis=0)[None], way, beyond=NEAR).any())
    return ~np.array(on, dtype=bool)
