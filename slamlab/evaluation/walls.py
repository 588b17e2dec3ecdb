"""How well an extractor finds walls: metres of the true ones found, metres where none is."""

import numpy as np

from slamlab.geometry import transform

STEP = 0.02  # m, lines are compared with walls at samples this far apart
LEAST_BEAMS, LEAST_LENGTH = 13, 0.4  # a wall seen by fewer, or of less, is not asked for [1, m]


def found_metres(world, pose, lines, within=0.1, slant=0.14):
    """Metres of found lines that lie on a wall, and that do not.

    Parameters
    ----------
    world : World
    pose : (3,) the true one of the scan [m, m, rad]
    lines : list of Line
    within : float, farthest from the wall and beyond its ends [m]
    slant : float, largest angle between line and wall [rad]

    Returns
    -------
    on, off : floats [m]
    """
    start, end = world.walls[:, :2], world.walls[:, 2:]
    length = np.hypot(*(end - start).T)
    way = (end - start) / length[:, None]
    on = off = 0
    for line in lines:
        a, b = transform(pose, line.ends)
        samples = a + np.linspace(0, 1, max(2, int(line.length / STEP)))[:, None] * (b - a)
        parallel = np.abs(way @ (b - a)) / line.length > np.cos(slant)
        offset = samples[:, None] - start
        along = np.sum(offset * way, axis=2)
        across = np.abs(offset[..., 0] * way[:, 1] - offset[..., 1] * way[:, 0])
        right = (across < within) & (along > -within) & (along < length + within) & parallel
        on += np.count_nonzero(right.any(axis=1)) * STEP
        off += np.count_nonzero(~right.any(axis=1)) * STEP
    return on, off


def seen_metres(world, pose, scan, hole=0.4):
    """Metres of wall that a scan shows: between neighbouring hits on the same wall.

    Parameters
    ----------
    world : World
    pose : (3,) [m, m, rad]
    scan : Scan taken there
    hole : float, farther apart two hits show at most this much of what lies between them [m]

    Returns
    -------
    float [m]
    """
    directions, total = pose[2] + scan.angles, 0.0
    reach = world.cast(pose[:2], directions)
    hits = pose[:2] + reach[:, None] * np.column_stack([np.cos(directions), np.sin(directions)])
    for x1, y1, x2, y2 in world.walls:
        length = np.hypot(x2 - x1, y2 - y1)
        way = np.array([x2 - x1, y2 - y1]) / length
        offset = hits - (x1, y1)
        along, across = offset @ way, offset @ [way[1], -way[0]]
        mine = (np.abs(across) < 1e-6) & (along > -1e-6) & (along < length + 1e-6) & scan.valid
        seen = np.sort(along[mine])
        if len(seen) >= LEAST_BEAMS and seen[-1] - seen[0] >= LEAST_LENGTH:
            total += float(np.minimum(np.diff(seen), hole).sum())
    return total
