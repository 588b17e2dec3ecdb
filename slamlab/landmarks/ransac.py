"""Walls in a scan by RANSAC: guess a line from a few neighbouring points, keep it if it holds.

Smolec §2.4: pick a random reading, fit a line through it and its neighbours, count who agrees.
``THESIS`` has his numbers; they fail with range, since noise grows and his band does not. By
default the band is the noise's own, and a wall grows from its first points along the scan.
"""

from dataclasses import dataclass

import numpy as np
from scipy.special import gammainc

from slamlab.landmarks.fit import Line, cloud, fit, total_least_squares

MOST_MISSES = 40  # guesses in a row that show no wall
GROWTHS = 8  # rounds of growing at most; a wall grows to its ends in three or four
EMPTY = 3  # empty beams in a row that happen by chance; more are a view into nothing


@dataclass(frozen=True)
class Ransac:
    """How walls are guessed and when they are believed.

    Parameters
    ----------
    window : int, neighbouring readings a guess is made of
    needed : int, of these have to lie in the band
    band : float, half its width [m], or None: ``sigmas`` standard deviations of each point
    sigmas : float
    roughness : float, largest mean square residual in units of its variance, when band is None
    grow : bool, whether the wall goes on beyond the window
    gap : float, widest hole of a wall that grows, if one beam goes through it; two end it [m]
    hidden : float, widest piece of a wall that things before it may hide, in gaps [1]
    shortest : float, least length of a wall [m]
    """

    window: int = 9
    needed: int = 8
    band: float | None = None
    sigmas: float = 2.8
    roughness: float = 1.6
    grow: bool = True
    gap: float = 0.4
    hidden: float = 3.0
    shortest: float = 0.3

    def __post_init__(self):
        if not 3 <= self.needed <= self.window:
            raise ValueError(f"needed is from 3 to the window of {self.window}, not {self.needed}")
        if (self.band is not None and self.band <= 0) or self.sigmas <= 0 or self.roughness <= 0:
            raise ValueError("band, sigmas and roughness are above zero")


THESIS = Ransac(window=25, needed=21, band=0.015, grow=False, shortest=0.0)
"""Smolec's parameters: 25 readings, 15 mm, at least 25 − 4."""


def lines(scan, sensor, rng, ransac=None):
    """The walls in a scan.

    Parameters
    ----------
    scan : Scan
    sensor : SensorModel, how noisy it is
    rng : numpy.random.Generator
    ransac : Ransac, its defaults when None

    Returns
    -------
    list of Line, the best supported first
    """
    ransac = ransac or Ransac()
    points = cloud(scan, sensor)
    free = np.ones(len(points), dtype=bool)
    found, misses = [], 0
    while misses < MOST_MISSES and free.sum() >= ransac.window:
        line, rows = _guess(points, free, rng, ransac)
        if line is None:
            misses += 1
            continue
        misses = 0
        free[rows] = False
        found.append((line, rows))
    found.sort(key=lambda pair: -len(pair[1]))
    if ransac.grow:
        walls = _settled(points, found, ransac)
    else:
        walls = [_line(points, line, rows, rows, ransac) for line, rows in found]
    return [wall for wall in walls if wall.length >= ransac.shortest]


def _guess(points, free, rng, ransac):
    """A line (ρ, α) round a random point and the rows on it, or two None."""
    rows = np.flatnonzero(free)
    middle = rng.integers(len(rows))
    # readings are neighbours round the whole turn
    rows = rows[(middle + np.arange(ransac.window) - ransac.window // 2) % len(rows)]
    middle, line = rows[ransac.window // 2], total_least_squares(points.points[rows])
    off, band = _off(points, rows, line, ransac)
    rows = rows[np.abs(off) <= band]
    for _ in range(GROWTHS if ransac.grow else 0):
        if len(rows) < ransac.needed:
            break
        before, (line, _) = rows, fit(points, rows, line, rounds=1)
        rows = _reached(points, free, line, middle, ransac)
        if np.array_equal(rows, before):
            break
    if len(rows) < ransac.needed:
        return None, None
    if ransac.band is None:
        off, band = _off(points, rows, line, ransac)
        if np.mean((off / band) ** 2) * ransac.sigmas**2 > ransac.roughness:
            return None, None
    return line, rows


def _off(points, rows, line, ransac):
    """How far points are off a line (ρ, α), outward, and how far they may be: (k,), (k,) [m]."""
    rho, alpha = line
    off = points.points[rows] @ [np.cos(alpha), np.sin(alpha)] - rho
    if ransac.band is not None:
        return off, np.full(len(off), ransac.band)
    return off, ransac.sigmas * np.sqrt(points.variance(rows, rho, alpha))


def _reached(points, free, line, middle, ransac):
    """The free points on a line both ways from a middle one, in the order of the beams.

    The wall ends where beams go through it. Where something stands before it, or nothing came
    back, it may go on.
    """
    beams = points.beams
    opposite = np.searchsorted(beams, (beams[middle] + points.total // 2) % points.total)
    order = np.roll(np.arange(len(points)), -opposite)  # no wall reaches round the robot to there
    off, band = _off(points, order, line, ransac)
    on = np.flatnonzero((np.abs(off) <= band) & free[order])
    if not len(on):
        return on
    along = points.points[order] @ [-np.sin(line[1]), np.cos(line[1])]
    through = off > band
    through[1:] |= np.diff(beams[order]) % points.total > EMPTY + 1
    views = np.diff(np.cumsum(through)[on])  # one may be noise
    apart, neighbours = np.abs(np.diff(along[on])), np.diff(on) == 1
    holes = (views > 1) | (views == 1) & (apart > ransac.gap)
    ends = np.flatnonzero(holes | ~neighbours & (apart > ransac.hidden * ransac.gap))
    nearest = np.abs(on - (middle - opposite) % len(points)).argmin()
    k = np.searchsorted(ends, nearest)
    first = ends[k - 1] + 1 if k else 0
    last = ends[k] + 1 if k < len(ends) else len(on)
    return order[on[first:last]]


def _settled(points, found, ransac):
    """The walls, each fitted without points that may be another's.

    Near a corner two walls want the same points. Who took them first would be turned by them, in
    every scan alike; that error would never average out. So they tell where a wall ends, but not
    how it stands. What wants hardly a point of its own is a wall that was found before.
    """
    everyone, kept, wanted = np.ones(len(points), dtype=bool), [], []
    for line, rows in found:
        mine = np.zeros(len(points), dtype=bool)
        mine[_reached(points, everyone, line, rows[len(rows) // 2], ransac)] = True
        if np.count_nonzero(mine & ~np.any(wanted, axis=0)) >= ransac.needed:
            kept.append(line)
            wanted.append(mine)
    once = np.sum(wanted, axis=0) == 1
    return [
        _line(points, line, np.flatnonzero(mine & once), np.flatnonzero(mine), ransac)
        for line, mine in zip(kept, wanted, strict=True)
        if np.count_nonzero(mine & once) >= ransac.needed
    ]


def _line(points, start, rows, extent, ransac):
    """A wall by the rows that are its own, as far as the points of its extent go."""
    z, R = fit(points, rows, start, rounds=2)
    rho, alpha = z
    normal, way = (np.array([np.cos(a), np.sin(a)]) for a in (alpha, alpha + np.pi / 2))
    along = points.points[extent] @ way
    ends = rho * normal + np.outer([along.min(), along.max()], way)
    if ransac.band is None:
        R = R * _cost_of_choice(ransac.sigmas)
    return Line(z, R, ends, points.beams[np.sort(rows)])


def _cost_of_choice(c):
    """By how much choosing its points makes a fit worse: P(χ²₁ < c²) / P(χ²₃ < c²).

    The band of c σ goes with the line, so the points it gains on one side and loses on the other
    pull the line further to where it errs. As for every Σ ψ(e/σ) = 0 the variance is that of ψ over
    the square of its mean slope; for ψ(e) = e in the band both are P(|e| < c) − 2 c φ(c).
    """
    return gammainc(0.5, c * c / 2) / gammainc(1.5, c * c / 2)
