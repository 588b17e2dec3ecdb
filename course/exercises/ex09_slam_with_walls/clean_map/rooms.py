"""Runs for task 09-clean-map: walls, temporary objects, false measurements.

The two runs of a pair have opposite errors: the means of their measurements of walls are exact.
"""

import numpy as np

from classroom.exercises.correctness_laws import once
from course.exercises.ex06_ekf_slam.runs import driven
from course.exercises.ex09_slam_with_walls.calls import EMPTY
from slamlab import models
from slamlab.geometry import wrap

STEPS, FAR = 40, 4.3  # scans of a run; a wall within FAR is in view [m]
START, WHEELS, EYES = np.array([[0.01, 0.01, 0.005], [0.03, 0.04, 0], [0.03, 0.015, 0]])
FOUND = 5  # one of so many scans with a wall in view misses it
STANDS = 12, 16  # number of scans in which a temporary object is present
ALONE = 12  # at least so many scans have its position in view without it
ANGLE, OFFSET = 0.35, 0.8  # temporary objects differ from walls and each other by one of these


def _tour(rng):
    half = rng.uniform((5.5, 3.75), (6.5, 4.25))
    turns = rng.uniform(0, 2 * np.pi) + rng.choice([-1, 1]) * np.linspace(0, 2 * np.pi, STEPS + 1)
    round_trip = (half - 2) * np.column_stack([np.cos(turns), np.sin(turns)])
    cut = np.arange(8) % 2 == 1
    alpha = np.arange(8) * np.pi / 4 + cut * rng.uniform(-0.2, 0.2, 8)
    normals = np.column_stack([np.cos(alpha), np.sin(alpha)])
    beyond = (round_trip @ normals.T).max(axis=0) + rng.uniform(0.8, 1.4, 8)
    rho = np.where(cut, beyond, np.tile(np.repeat(half, 2), 2))
    turn, shift = rng.uniform(-np.pi, np.pi), rng.uniform(-3, 3, 2)
    c, s = np.cos(turn), np.sin(turn)
    places = round_trip @ [[c, s], [-s, c]] + shift
    steps = np.diff(places, axis=0)
    heading = np.arctan2(steps[:, 1], steps[:, 0])
    us = np.column_stack([np.hypot(*steps[:-1].T), wrap(np.diff(heading))])
    alpha = wrap(alpha + turn)
    walls = np.column_stack([rho + shift @ [np.cos(alpha), np.sin(alpha)], alpha])
    return np.append(places[0], heading[0]), us, walls


def in_view(way, line):
    """Whether each pose is in front of a line, within FAR: (t,)."""
    off = line[0] - way[:, :2] @ [np.cos(line[1]), np.sin(line[1])]
    return (off > 0) & (off <= FAR)


def along(start, us):
    """The poses of all scans, the start first: (t, 3)."""
    return np.vstack([start, driven(start, us)])


def from_middle(lines, way):
    """Lines (k, 2) with ρ from the mean position, where a rotated map has the smallest errors."""
    lines = np.reshape(lines, (-1, 2))
    normals = np.column_stack([np.cos(lines[:, 1]), np.sin(lines[:, 1])])
    return np.column_stack([lines[:, 0] - normals @ way[:, :2].mean(axis=0), lines[:, 1]])


def _things(rng, way, walls, count):
    """Temporary objects, as lines, and the scans in which each is present."""
    found, taken = [], walls
    while len(found) < count:
        z = rng.uniform((0.5, -np.pi), (3, np.pi))
        line = models.g_line(way[rng.integers(STEPS)], z)
        times, stands = np.flatnonzero(in_view(way, line)), rng.integers(*STANDS)
        off = np.abs(from_middle(taken, way) - from_middle(line, way))
        off[:, 1] = np.abs(wrap(off[:, 1]))
        spare = len(times) - stands - ALONE
        if spare < 0 or ((off[:, 0] < OFFSET) & (off[:, 1] < ANGLE)).any():
            continue
        first = rng.integers(spare + 1)
        found.append((line, times[first : first + stands]))
        taken = np.vstack([taken, line])
    return found


def _kept(rng, times, missed):
    """The scans that detect a line: one of FOUND in a row misses it."""
    gone = set()
    for k in range(0, len(times), FOUND):
        free = [t for t in times[k : k + FOUND] if t > 0 and t not in missed]
        if free and k + FOUND <= len(times):
            gone.add(rng.choice(free))
    missed |= gone
    return [t for t in times if t not in gone]


def _pair(rng, things, false):
    """One trajectory in two runs with opposite errors: starts, control inputs, scans."""
    while True:
        start, us, walls = _tour(rng)
        way = along(start, us)
        views = np.array([in_view(way, wall) for wall in walls])
        if views.sum(axis=1).min() >= 8 and views.sum(axis=0).min() >= 2:
            break
    scans, missed, twice = [[] for _ in way], set(), np.array([1.0, -1.0])[:, None]
    for wall, seen in zip(walls, views, strict=True):
        for t in _kept(rng, np.flatnonzero(seen), missed):
            scans[t].append(models.h_line(way[t], wall) + EYES[:2] * rng.standard_normal(2) * twice)
    for line, times in _things(rng, way, walls, things):
        for t in _kept(rng, times, set()):
            scans[t].append(models.h_line(way[t], line) + EYES[:2] * rng.standard_normal((2, 2)))
    for scan in scans:
        for _ in range(rng.integers(false + 1)):
            z = rng.uniform((0.3, -np.pi), (FAR, np.pi))
            scan.append(z + EYES[:2] * rng.standard_normal((2, 2)))
    table = np.full((2, len(scans), max(map(len, scans)), 2), EMPTY)
    for t, scan in enumerate(scans):
        for k, z in enumerate(rng.permutation(scan)):
            table[:, t, k, 0], table[:, t, k, 1] = z[:, 0], wrap(z[:, 1])
    started = start + START * rng.standard_normal(3) * twice
    return (
        started,
        us + WHEELS[:2] * rng.standard_normal(us.shape) * twice[..., None],
        table,
    )


def runs(rng, rooms=18, things=3, false=2):
    """Two runs through each room.
    things : temporary objects of a room; false : most false measurements of a scan.
    """
    x, u, scans = zip(*[_pair(rng, things, false) for _ in range(rooms)], strict=True)
    most = max(table.shape[2] for table in scans)
    scans = [
        np.pad(t, ((0, 0), (0, 0), (0, most - t.shape[2]), (0, 0)), constant_values=EMPTY)
        for t in scans
    ]
    covariances = zip("PCR", (START, WHEELS[:2], EYES[:2]), strict=True)
    return {
        "x": np.concatenate(x),
        "us": np.concatenate(u),
        "scans": np.concatenate(scans),
        "far": np.full(2 * rooms, FAR),
        **{name: np.tile(np.diag(sigma**2), (2 * rooms, 1, 1)) for name, sigma in covariances},
    }


@once
def truth(inputs):
    """For each room the true trajectory (t, 3) and the walls (k, 2)."""
    found = []
    for k in range(0, len(inputs["x"]), 2):
        pair = slice(k, k + 2)
        way = along(inputs["x"][pair].mean(axis=0), inputs["us"][pair].mean(axis=0))
        one, other = inputs["scans"][pair]
        middle = one + (other - one) / 2
        middle[..., 1] = one[..., 1] + wrap(other - one)[..., 1] / 2
        lines = np.concatenate(
            [models.g_line(pose, z[z[:, 0] < EMPTY]) for pose, z in zip(way, middle, strict=True)]
        )
        same = np.column_stack([lines[:, 0], np.cos(lines[:, 1]), np.sin(lines[:, 1])]).round(6)
        _, first, times = np.unique(same, axis=0, return_index=True, return_counts=True)
        found.append((way, lines[first[times >= 3]]))
    return found
