"""How good is line extraction: metres of wall that a scan shows, that are found, that are invented.

Of recall and precision a simulation knows both sides; lesson 08 puts Smolec's numbers beside the
package's.
"""

from dataclasses import dataclass

import numpy as np

from slamlab.geometry import transform
from slamlab.landmarks.ransac import lines
from slamlab.sources.simulated_robot import THESIS_LIDAR

STEP = 0.02  # between samples of a wall or a line [m]
NEAR, PARALLEL = 0.1, np.cos(0.14)  # a line lies on a wall within 10 cm and 8° [m], [1]
MIN_BEAMS, MIN_LENGTH = 13, 0.4  # of a wall that a scan is said to show [1], [m]
MAX_HOLE = 0.4  # between two hits; of a wider hole only the rims are shown [m]
MIN_ROOM = 0.3  # between a robot and the nearest wall [m]


@dataclass(frozen=True)
class Metres:
    """Metres of wall and of line; sums of them add up.

    Parameters
    ----------
    shown, covered : float, of wall that scans show, and of these where a line lies [m]
    right, wrong : float, of line that lie on a wall, and that do not [m]
    """

    shown: float = 0.0
    covered: float = 0.0
    right: float = 0.0
    wrong: float = 0.0

    def __add__(self, other):
        return Metres(*np.add(list(vars(self).values()), list(vars(other).values())))

    @property
    def recall(self):
        """Share of the shown walls that was found [1]."""
        return self.covered / self.shown if self.shown else np.nan

    @property
    def false(self):
        """Share of the found lines that is no wall [1]."""
        return self.wrong / (self.right + self.wrong) if self.right + self.wrong else 0.0


def judge(world, pose, scan, found):
    """Judge the lines found in one scan by the walls of the world.

    Parameters
    ----------
    world : World
    pose : (3,) from where the scan was truly made
    scan : Scan
    found : list of Line

    Returns
    -------
    Metres
    """
    ends = np.array([transform(pose, line.ends).ravel() for line in found]).reshape(-1, 4)
    shown = covered = right = wrong = 0.0
    for samples, way in _shown(world, pose, scan):
        shown += STEP * len(samples)
        covered += STEP * lie_on(ends, samples, way).sum()
    for line in ends:
        samples, way = _sampled(line)
        good = lie_on(world.walls, samples, way, beyond=NEAR)
        right, wrong = right + STEP * good.sum(), wrong + STEP * (~good).sum()
    return Metres(shown, covered, right, wrong)


def judge_places(world, ransac=None, count=25, seed=1, lidar=THESIS_LIDAR):
    """Judge line extraction from places anywhere in a world.

    Parameters
    ----------
    world : World
    ransac : Ransac, its defaults when None
    count : int, places
    seed : int
    lidar : Lidar

    Returns
    -------
    Metres
    """
    rng, total = np.random.default_rng(seed), Metres()
    for pose in places(world, count, rng):
        scan = lidar.scan(world, pose, rng)
        total += judge(world, pose, scan, lines(scan, lidar.model, rng, ransac))
    return total


def places(world, count, rng):
    """Poses anywhere free inside a world: walls on all sides, none near.

    Parameters
    ----------
    world : World
    count : int
    rng : numpy.random.Generator

    Returns
    -------
    list of (3,) poses
    """
    corners, found = world.walls.reshape(-1, 2), []
    while len(found) < count:
        place = rng.uniform(corners.min(axis=0), corners.max(axis=0))
        around = world.cast(place, np.linspace(0, 2 * np.pi, 90))
        if np.isfinite(around).all() and around.min() > MIN_ROOM:
            found.append(np.array([*place, rng.uniform(-3, 3)]))
    return found


def lie_on(pieces, points, way, beyond=0.0):
    """Which points of something straight lie on one of some pieces of wall or line.

    Parameters
    ----------
    pieces : (k, 4) x1 y1 x2 y2 [m]
    points : (n, 2) [m]
    way : (2,) unit vector along which the points run
    beyond : float, how far beyond a piece's end still counts [m]

    Returns
    -------
    (n,) bool
    """
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
    """For each wall that a scan shows: samples of what it shows (n, 2), and the wall's way (2,)."""
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
