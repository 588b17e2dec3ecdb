"""Metrics of line extraction: recall and precision of walls, in metres."""

import numpy as np

from slamlab.geometry import transform

STEP = 0.02  # distance of the samples at which lines are compared with walls [m]
MIN_BEAMS, MIN_LENGTH = 13, 0.4  # least beams and length of a wall that must be found [1, m]
MAX_GAP = 0.4  # in wider gaps only half of this counts as observed beside each hit [m]
MAX_DISTANCE, MAX_ANGLE = 0.1, 0.14  # largest distance and angle of a matching line [m, rad]


def recall_metres(world, pose, scan, lines):
    """Compute the recall: metres of wall that a scan observes, and metres that the lines cover.
    Returns seen and found [m].

    Parameters
    ----------
    world : World
    pose : (3,) the true pose [m, m, rad]
    scan : Scan
    lines : list of Line
    """
    ends = np.array([transform(pose, line.ends).ravel() for line in lines]).reshape(-1, 4)
    seen = found = 0
    for samples, direction in _visible_walls(world, pose, scan):
        seen += len(samples)
        found += np.count_nonzero(_matched(ends, samples, direction))
    return seen * STEP, found * STEP


def precision_metres(world, pose, lines):
    """Compute the precision: metres of lines that are on a wall, and metres that are not. Returns
    right and wrong [m].

    Parameters
    ----------
    world : World
    pose : (3,) the true pose [m, m, rad]
    lines : list of Line
    """
    right = wrong = 0
    for line in lines:
        a, b = transform(pose, line.ends)
        samples = a + np.linspace(0, 1, max(2, int(line.length / STEP)))[:, None] * (b - a)
        # a line may end a little beyond its wall
        good = np.count_nonzero(_matched(world.walls, samples, (b - a) / line.length, MAX_DISTANCE))
        right, wrong = right + good, wrong + len(samples) - good
    return right * STEP, wrong * STEP


def _matched(segments, points, direction, beyond=0.0):
    """Select samples of a segment with ``direction`` that match segments, rows x1 y1 x2 y2."""
    start, end = segments[:, :2], segments[:, 2:]
    length = np.hypot(*(end - start).T)
    u = (end - start) / length[:, None]
    offset = points[:, None] - start
    along = np.sum(offset * u, axis=2)
    across = np.abs(offset[..., 0] * u[:, 1] - offset[..., 1] * u[:, 0])
    close = (across < MAX_DISTANCE) & (along >= -beyond) & (along <= length + beyond)
    return (close & (np.abs(u @ direction) > np.cos(MAX_ANGLE))).any(axis=1)


def _visible_walls(world, pose, scan):
    """Return, for each visible wall, samples (n, 2) of the observed parts, and the direction."""
    directions = pose[2] + scan.angles[scan.valid]
    reach = world.cast(pose[:2], directions)
    hits = pose[:2] + reach[:, None] * np.column_stack([np.cos(directions), np.sin(directions)])
    for x1, y1, x2, y2 in world.walls:
        length = np.hypot(x2 - x1, y2 - y1)
        direction = np.array([x2 - x1, y2 - y1]) / length
        offset = hits - (x1, y1)
        along, across = offset @ direction, offset @ [direction[1], -direction[0]]
        t = np.sort(along[(np.abs(across) < 1e-6) & (along > -1e-6) & (along < length + 1e-6)])
        if len(t) >= MIN_BEAMS and t[-1] - t[0] >= MIN_LENGTH:
            samples = np.arange(t[0], t[-1], STEP)
            after = np.searchsorted(t, samples, side="right")
            beside = np.minimum(samples - t[after - 1], t[np.minimum(after, len(t) - 1)] - samples)
            yield (x1, y1) + samples[beside <= MAX_GAP / 2, None] * direction, direction
