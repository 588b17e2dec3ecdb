"""Recall and false positives of line extraction, in metres of true wall (lesson 08)."""

from dataclasses import dataclass

import numpy as np

from slamlab.geometry import transform
from slamlab.landmarks.ransac import lines
from slamlab.sources.simulated_robot import THESIS_LIDAR

STEP = 0.02  # between samples of a wall or a line [m]
NEAR, PARALLEL = 0.1, np.cos(0.14)  # a line lies on a wall within 10 cm and 8° [m], [1]
MIN_BEAMS, MIN_LENGTH = 13, 0.4  # of a wall that counts as visible in a scan [1], [m]
MAX_HOLE = 0.4  # between two hits; only the rims of a wider hole count as visible [m]
MIN_ROOM = 0.3  # between a robot and the nearest wall [m]


@dataclass(frozen=True)
class Metres:
    """Lengths of walls that are visible (``shown``) and ``covered`` by lines, and of lines on a
    wall (``right``) and off all walls (``wrong``) [m]. The sum of two Metres is a Metres."""

    shown: float = 0.0
    covered: float = 0.0
    right: float = 0.0
    wrong: float = 0.0

    def __add__(self, other):
        return Metres(*np.add(list(vars(self).values()), list(vars(other).values())))

    @property
    def recall(self):
        """The share of the visible wall length that was found [1]."""
        return self.covered / self.shown if self.shown else np.nan

    @property
    def false(self):
        """The share of the found line length that is not on a wall [1]."""
        return self.wrong / (self.right + self.wrong) if self.right + self.wrong else 0.0


def judge(world, pose, scan, found):
    """Evaluate the lines found in one scan from a known pose."""
    ends = np.array([transform(pose, line.ends).ravel() for line in found]).reshape(-1, 4)
    shown = covered = right = wrong = 0.0
    for samples, way in _shown(world, pose, scan):
        shown += STEP * len(samples)
        covered += STEP * on_wall(ends, samples, way).sum()
    for line in ends:
        samples, way = _sampled(line)
        good = on_wall(world.walls, samples, way, beyond=NEAR)
        right, wrong = right + STEP * good.sum(), wrong + STEP * (~good).sum()
    return Metres(shown, covered, right, wrong)


def evaluate_world(world, ransac=None, count=25, seed=1, lidar=THESIS_LIDAR):
    """Evaluate line extraction from ``count`` random poses in a world."""
    rng, total = np.random.default_rng(seed), Metres()
    for pose in places(world, count, rng):
        scan = lidar.scan(world, pose, rng)
        total += judge(world, pose, scan, lines(scan, lidar.model, rng, ransac))
    return total


def places(world, count, rng):
    """Draw ``count`` poses (3,) in the free space of a world."""
    corners, found = world.walls.reshape(-1, 2), []
    while len(found) < count:
        place = rng.uniform(corners.min(axis=0), corners.max(axis=0))
        around = world.cast(place, np.linspace(0, 2 * np.pi, 90))
        if np.isfinite(around).all() and around.min() > MIN_ROOM:
            found.append(np.array([*place, rng.uniform(-3, 3)]))
    return found


def on_wall(pieces, points, way, beyond=0.0):
    """Return a mask of the points (n, 2) of a line with unit vector ``way`` that are on a segment
    (k, 4) or up to ``beyond`` [m] past its ends."""
    start, end = pieces[:, :2], pieces[:, 2:]
    length = np.hypot(*(end - start).T)
    u = (end - start) / length[:, None]
    offset = points[:, None] - start
    along = np.sum(offset * u, axis=2)
    off = np.abs(offset[..., 0] * u[:, 1] - offset[..., 1] * u[:, 0])
    close = (off < NEAR) & (along >= -beyond) & (along <= length + beyond)
    return (close & (np.abs(u @ way) > PARALLEL)).any(axis=1)


def _sampled(piece):
    start, end = piece[:2], piece[2:]
    length = np.hypot(*(end - start))
    samples = start + np.linspace(0, 1, max(2, int(length / STEP)))[:, None] * (end - start)
    return samples, (end - start) / length


def _shown(world, pose, scan):
    """Yield for each visible wall sample points (n, 2) and the direction (2,)."""
    directions = pose[2] + scan.angles[scan.valid]
    reach = world.cast(pose[:2], directions)
    hits = pose[:2] + reach[:, None] * np.column_stack([np.cos(directions), np.sin(directions)])
    for wall in world.walls:
        length = np.hypot(*(wall[2:] - wall[:2]))
        way = (wall[2:] - wall[:2]) / length
        t, off = (hits - wall[:2]) @ way, (hits - wall[:2]) @ [way[1], -way[0]]
        t = np.sort(t[(np.abs(off) < 1e-6) & (t > -1e-6) & (t < length + 1e-6)])
        if len(t) >= MIN_BEAMS and np.ptp(t) >= MIN_LENGTH:
            samples = np.arange(t[0], t[-1], STEP)
            rim = np.abs(samples[:, None] - t).min(axis=1) <= MAX_HOLE / 2
            yield wall[:2] + samples[rim, None] * way, way
