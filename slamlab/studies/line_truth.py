"""Lines of simulated scans against the true walls: which wall each is of, and how far it is off."""

import numpy as np

from slamlab.evaluation import nees
from slamlab.geometry import transform, wrap
from slamlab.models.observation import g_line, h_line
from slamlab.studies.corridor import feet


def lines_of(walls):
    """The lines of walls, ρ ≥ 0.

    Parameters
    ----------
    walls : (n, 4) x1 y1 x2 y2 [m]

    Returns
    -------
    (n, 2) ρ [m], α [rad]
    """
    alpha = np.arctan2(walls[:, 2] - walls[:, 0], -(walls[:, 3] - walls[:, 1]))
    rho = walls[:, 0] * np.cos(alpha) + walls[:, 1] * np.sin(alpha)
    return np.column_stack([abs(rho), wrap(alpha + np.pi * (rho < 0))])


def expected_from(pose, lines):
    """What a robot sees of lines, from whichever side it stands: ρ' ≥ 0.

    Parameters
    ----------
    pose : (3,) [m, m, rad]
    lines : (n, 2) ρ [m], α [rad]

    Returns
    -------
    (n, 2) ρ' [m], α' [rad], not wrapped
    """
    expected = h_line(pose, lines)
    other_side = expected[:, :1] < 0  # than the world's origin
    return np.where(other_side, expected * [-1, 1] + [0, np.pi], expected)


def wall_under(ends, walls):
    """The wall on which a seen piece lies.

    Parameters
    ----------
    ends : (2, 2) points [m]
    walls : (n, 4) x1 y1 x2 y2 [m]

    Returns
    -------
    int, its row
    """
    start, way = walls[:, :2], walls[:, 2:] - walls[:, :2]
    offset = ends[:, None] - start
    along = np.clip(np.sum(offset * way, axis=2) / np.sum(way**2, axis=1), 0, 1)
    off = np.hypot(*np.moveaxis(offset - along[..., None] * way, -1, 0))
    return int(off.sum(axis=0).argmin())


def squared_errors(source, found):
    """Squared errors of lines in units of their R, at true poses: 2 on average where R is right.

    Parameters
    ----------
    source : Simulation
    found : list of lists of Line, of each scan

    Returns
    -------
    (m,) [1]
    """
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
    """Sightings that have more than one foot to choose from, at true poses, and who chooses well.

    Parameters
    ----------
    source : Simulation
    found : list of lists of Line, of each scan
    offset : float, within which a foot may be that of a sighting [m]

    Returns
    -------
    dict: how many "sightings", how many "with a choice"; of these, in how many "the first" foot of
    the list and "the nearest" is the right one
    """
    walls = source.world.walls
    true = feet(lines_of(walls)).round(6) + 0.0
    different = np.unique(true, axis=0)
    counts = dict.fromkeys(("sightings", "with a choice", "the first", "the nearest"), 0)
    for pose, seen in zip(source.truth.poses, found, strict=True):
        for line in seen:
            away = np.hypot(*(different - feet(g_line(pose, line.z))).T)
            within, right = (
                np.flatnonzero(away < offset),
                true[wall_under(transform(pose, line.ends), walls)],
            )
            counts["sightings"] += 1
            if len(within) > 1:
                counts["with a choice"] += 1
                counts["the first"] += bool((different[within[0]] == right).all())
                counts["the nearest"] += bool((different[away.argmin()] == right).all())
    return counts
