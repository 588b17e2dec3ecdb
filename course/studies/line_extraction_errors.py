"""Errors of lines extracted from simulated scans relative to the true walls, in units of their
covariance."""

import numpy as np

from course.studies.corridor import foot_points
from slamlab.evaluation import nees
from slamlab.geometry import transform, wrap
from slamlab.models.observation import g_line, h_line


def lines_of(walls):
    """Return the lines (n, 2) ρ ≥ 0 [m], α [rad] of walls (n, 4)."""
    alpha = np.arctan2(walls[:, 2] - walls[:, 0], -(walls[:, 3] - walls[:, 1]))
    rho = walls[:, 0] * np.cos(alpha) + walls[:, 1] * np.sin(alpha)
    return np.column_stack([abs(rho), wrap(alpha + np.pi * (rho < 0))])


def expected_from(pose, lines):
    """Return the expected observations of lines (n, 2): ρ' ≥ 0 [m], α' [rad], not wrapped."""
    expected = h_line(pose, lines)
    other_side = expected[:, :1] < 0  # than the world's origin
    return np.where(other_side, expected * [-1, 1] + [0, np.pi], expected)


def wall_under(ends, walls):
    """Return the row index of the wall (n, 4) nearest to an observed line segment (2, 2) [m]."""
    start, vector = walls[:, :2], walls[:, 2:] - walls[:, :2]
    offset = ends[:, None] - start
    along = np.clip(np.sum(offset * vector, axis=2) / np.sum(vector**2, axis=1), 0, 1)
    off = np.hypot(*np.moveaxis(offset - along[..., None] * vector, -1, 0))
    return int(off.sum(axis=0).argmin())


def squared_errors(source, found):
    """Return the NEES (m,) of each scan's lines with their R; the mean is 2 if R is right."""
    walls, off, R = source.world.walls, [], []
    for pose, seen in zip(source.truth.poses, found, strict=True):
        expected = expected_from(pose, lines_of(walls))
        for line in seen:
            off.append(line.z - expected[wall_under(transform(pose, line.ends), walls)])
            R.append(line.R)
    off = np.array(off)
    off[:, 1] = wrap(off[:, 1])
    return nees(off, np.array(R))


def choices(source, found, offset):
    """Count observed lines ("observations") and those "with a choice" of several true foot points
    within the offset [m]. Of the latter, count those for which "the first" or "the nearest" is
    right."""
    walls = source.world.walls
    true = foot_points(lines_of(walls)).round(6) + 0.0
    different = np.unique(true, axis=0)
    counts = dict.fromkeys(("observations", "with a choice", "the first", "the nearest"), 0)
    for pose, seen in zip(source.truth.poses, found, strict=True):
        for line in seen:
            away = np.hypot(*(different - foot_points(g_line(pose, line.z))).T)
            within, right = (
                np.flatnonzero(away < offset),
                true[wall_under(transform(pose, line.ends), walls)],
            )
            counts["observations"] += 1
            if len(within) > 1:
                counts["with a choice"] += 1
                counts["the first"] += bool((different[within[0]] == right).all())
                counts["the nearest"] += bool((different[away.argmin()] == right).all())
    return counts
