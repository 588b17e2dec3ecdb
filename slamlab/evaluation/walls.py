"""How well an extractor finds walls: metres of the true ones found, metres where none is."""

import numpy as np

from slamlab.geometry import transform

STEP = 0.02  # m, lines are compared with walls at samples this far apart
LEAST_BEAMS, LEAST_LENGTH = 13, 0.4  # a wall seen by fewer, or of less, is not asked for [1, m]
HOLE = 0.4  # m, hits farther apart show half of this beside each of the two
WITHIN, SLANT = 0.1, 0.14  # m, rad: what lies nearer to a piece, and so parallel, is on it


def recall_metres(world, pose, scan, lines):
    """Metres of wall that a scan shows, and metres of these that lines lie on.

    Parameters
    ----------
    world : World
    pose : (3,) the true one of the scan [m, m, rad]
    scan : Scan taken there
    lines : list of Line found in it

    Returns
    -------
    seen, found : floats, found ≤ seen [m]
    """
    ends = np.array([transform(pose, line.ends).ravel() for line in lines]).reshape(-1, 4)
    seen = found = 0
    for samples, way in _shown(world, pose, scan):
        seen += len(samples)
        found += np.count_nonzero(_on(ends, samples, way))
    return seen * STEP, found * STEP


def precision_metres(world, pose, lines):
    """Metres of found lines that lie on a wall, and that do not.

    Parameters
    ----------
    world : World
    pose : (3,) the true one of the scan [m, m, rad]
    lines : list of Line

    Returns
    -------
    right, wrong : floats [m]
    """
    right = wrong = 0
    for line in lines:
        a, b = transform(pose, line.ends)
        samples = a + np.linspace(0, 1, max(2, int(line.length / STEP)))[:, None] * (b - a)
        # a line that ends a little beyond its wall is not wrong there
        good = np.count_nonzero(_on(world.walls, samples, (b - a) / line.length, WITHIN))
        right, wrong = right + good, wrong + len(samples) - good
    return right * STEP, wrong * STEP


def _on(pieces, points, way, beyond=0.0):
    """Which points of something that runs along a way lie on pieces, rows x1 y1 x2 y2, of it."""
    start, end = pieces[:, :2], pieces[:, 2:]
    length = np.hypot(*(end - start).T)
    u = (end - start) / length[:, None]
    offset = points[:, None] - start
    along = np.sum(offset * u, axis=2)
    across = np.abs(offset[..., 0] * u[:, 1] - offset[..., 1] * u[:, 0])
    close = (across < WITHIN) & (along >= -beyond) & (along <= length + beyond)
    return (close & (np.abs(u @ way) > np.cos(SLANT))).any(axis=1)


def _shown(world, pose, scan):
    """For each wall that a scan shows: (n, 2) samples of what lies between its hits, its way."""
    directions = pose[2] + scan.angles[scan.valid]
    reach = world.cast(pose[:2], directions)
    hits = pose[:2] + reach[:, None] * np.column_stack([np.cos(directions), np.sin(directions)])
    for x1, y1, x2, y2 in world.walls:
        length = np.hypot(x2 - x1, y2 - y1)
        way = np.array([x2 - x1, y2 - y1]) / length
        offset = hits - (x1, y1)
        along, across = offset @ way, offset @ [way[1], -way[0]]
        t = np.sort(along[(np.abs(across) < 1e-6) & (along > -1e-6) & (along < length + 1e-6)])
        if len(t) >= LEAST_BEAMS and t[-1] - t[0] >= LEAST_LENGTH:
            samples = np.arange(t[0], t[-1], STEP)
            after = np.searchsorted(t, samples, side="right")
            beside = np.minimum(samples - t[after - 1], t[np.minimum(after, len(t) - 1)] - samples)
            yield (x1, y1) + samples[beside <= HOLE / 2, None] * way, way
