"""Recall and precision of wall (line) extraction, in metres of wall."""

import numpy as np

from slamlab.geometry import transform

STEP = 0.02  # lines are compared with walls at samples this far apart [m]
MIN_BEAMS, MIN_LENGTH = 13, 0.4  # a wall seen by fewer, or of less, is not asked for [1, m]
MAX_GAP = 0.4  # hits farther apart show half of this beside each of the two [m]
MAX_DISTANCE, MAX_ANGLE = 0.1, 0.14  # to match: what lies so near a wall, and so parallel [m, rad]


def recall_metres(world, pose, scan, lines):
    """Recall: metres of wall that a scan shows, and metres of these that lines lie on.

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
    for samples, way in _visible_walls(world, pose, scan):
        seen += len(samples)
        found += np.count_nonzero(_matched(ends, samples, way))
    return seen * STEP, found * STEP


def precision_metres(world, pose, lines):
    """Precision: metres of found lines that lie on a wall (true positives), and that do not.

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
        good = np.count_nonzero(_matched(world.walls, samples, (b - a) / line.length, MAX_DISTANCE))
        right, wrong = right + good, wrong + len(samples) - good
    return right * STEP, wrong * STEP


def _matched(segments, points, way, beyond=0.0):
    """Which samples of a segment with direction ``way`` match segments, rows x1 y1 x2 y2."""
    start, end = segments[:, :2], segments[:, 2:]
    length = np.hypot(*(end - start).T)
    u = (end - start) / length[:, None]
    offset = points[:, None] - start
    along = np.sum(offset * u, axis=2)
    across = np.abs(offset[..., 0] * u[:, 1] - offset[..., 1] * u[:, 0])
    close = (across < MAX_DISTANCE) & (along >= -beyond) & (along <= length + beyond)
    return (close & (np.abs(u @ way) > np.cos(MAX_ANGLE))).any(axis=1)


def _visible_walls(world, pose, scan):
    """For each wall visible in a scan: (n, 2) samples of what lies between its hits, its way."""
    directions = pose[2] + scan.angles[scan.valid]
    reach = world.cast(pose[:2], directions)
    hits = pose[:2] + reach[:, None] * np.column_stack([np.cos(directions), np.sin(directions)])
    for x1, y1, x2, y2 in world.walls:
        length = np.hypot(x2 - x1, y2 - y1)
        way = np.array([x2 - x1, y2 - y1]) / length
        offset = hits - (x1, y1)
        along, across = offset @ way, offset @ [way[1], -way[0]]
        t = np.sort(along[(np.abs(across) < 1e-6) & (along > -1e-6) & (along < length + 1e-6)])
        if len(t) >= MIN_BEAMS and t[-1] - t[0] >= MIN_LENGTH:
            samples = np.arange(t[0], t[-1], STEP)
            after = np.searchsorted(t, samples, side="right")
            beside = np.minimum(samples - t[after - 1], t[np.minimum(after, len(t) - 1)] - samples)
            yield (x1, y1) + samples[beside <= MAX_GAP / 2, None] * way, way
