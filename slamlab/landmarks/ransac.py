"""Walls in a scan by RANSAC: guess a line from a few neighbouring points, keep it if it holds.

Smolec §2.4: pick a random reading, fit a line through it and its neighbours, count who agrees.
``THESIS`` has his numbers; they fail with range, since noise grows and his band does not. By
default the band is the noise's own, and a wall grows from its first points along the scan.
"""

from dataclasses import dataclass

import numpy as np

from slamlab.landmarks.fit import Line, cloud, fit, total_least_squares

MOST_MISSES = 25  # guesses in a row that show no wall
GROWTHS = 8  # rounds of growing at most; a wall grows to its ends in three or four
EDGE = 0.2  # m, beyond its ends a wall still claims points
FAR_APART = 2  # beams: far readings of a wall seen at a slant are metres apart, yet neighbours


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
    gap : float, largest hole in a wall that grows [m]
    shortest : float, least length of a wall [m]
    """

    window: int = 11
    needed: int = 8
    band: float | None = None
    sigmas: float = 2.8
    roughness: float = 1.6
    grow: bool = True
    gap: float = 0.4
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
        if line.length >= ransac.shortest:
            found.append((line, rows))
    if ransac.grow:
        found = _settled(points, found, ransac)
    return [line for line, _ in sorted(found, key=lambda pair: -len(pair[1]))]


def _guess(points, free, rng, ransac):
    """A wall round a random point and the rows on it, or two None."""
    rows = np.flatnonzero(free)
    middle = rng.integers(len(rows))
    # readings are neighbours round the whole turn
    window = rows[(middle + np.arange(ransac.window) - ransac.window // 2) % len(rows)]
    inside = window[_inside(points, window, total_least_squares(points.points[window]), ransac)]
    if len(inside) >= ransac.needed and ransac.grow:
        inside = _grown(points, rows, middle, inside, ransac)
    if len(inside) < ransac.needed:
        return None, None
    line = _line(points, inside)
    if ransac.band is None and _roughness(points, inside, line.z) > ransac.roughness:
        return None, None
    return line, inside


def _inside(points, rows, line, ransac):
    """Which of some points lie in the band round a line (ρ, α)."""
    rho, alpha = line
    off = np.abs(points.points[rows] @ [np.cos(alpha), np.sin(alpha)] - rho)
    if ransac.band is not None:
        return off <= ransac.band
    return off <= ransac.sigmas * np.sqrt(points.variance(rows, rho, alpha))


def _roughness(points, rows, line):
    """Mean square distance of points from their line, in units of its variance."""
    rho, alpha = line
    off = points.points[rows] @ [np.cos(alpha), np.sin(alpha)] - rho
    return np.mean(off**2 / points.variance(rows, rho, alpha))


def _grown(points, rows, middle, inside, ransac):
    """The wall both ways from its middle as far as no hole interrupts it; fitted anew each time."""
    turned = np.roll(rows, len(rows) // 2 - middle)  # the middle of the scan is the wall's
    for _ in range(GROWTHS):
        before, (line, _) = inside, fit(points, inside)
        way = np.array([-np.sin(line[1]), np.cos(line[1])])
        on = turned[_inside(points, turned, line, ransac)]
        along, start = points.points[on] @ way, points.points[rows[middle]] @ way
        holes = (np.abs(np.diff(along)) > ransac.gap) & (_apart(points, on) > FAR_APART)
        pieces = np.split(np.arange(len(on)), np.flatnonzero(holes) + 1)
        nearest = [np.abs(along[piece] - start).min() if len(piece) else np.inf for piece in pieces]
        inside = on[pieces[int(np.argmin(nearest))]]
        if len(inside) < ransac.needed or np.array_equal(inside, before):
            break
    return inside


def _settled(points, found, ransac):
    """The walls without the points that may be another's: near a corner, two walls want them.

    Who came first has taken some of its neighbour's points, always on the same side, and is turned
    by them in every scan alike; that error would never average out.
    """
    if len(found) < 2:
        return found
    off = np.full((len(found), len(points)), np.inf)
    for row, (line, _) in zip(off, found, strict=True):
        rho, alpha = line.z
        way = np.array([-np.sin(alpha), np.cos(alpha)])
        low, high = line.ends @ way
        along = points.points @ way
        near = np.flatnonzero((along > low - EDGE) & (along < high + EDGE))
        across = points.points[near] @ [np.cos(alpha), np.sin(alpha)] - rho
        row[near] = across**2 / points.variance(near, rho, alpha)
    wanted = off <= ransac.sigmas**2
    settled = []
    for mine in wanted & (wanted.sum(axis=0) == 1):
        rows = np.flatnonzero(mine)
        if len(rows) >= ransac.needed:
            settled.append((_line(points, rows), rows))
    return settled


def _apart(points, rows):
    """Beams between a reading and the next of some, round the turn."""
    steps = np.abs(np.diff(points.beams[rows]))
    return np.minimum(steps, points.total - steps)


def _line(points, rows):
    z, R = fit(points, rows)
    rho, alpha = z
    normal, way = (np.array([np.cos(a), np.sin(a)]) for a in (alpha, alpha + np.pi / 2))
    along = points.points[rows] @ way
    ends = rho * normal + np.outer([along.min(), along.max()], way)
    return Line(z, R, ends, points.beams[np.sort(rows)])
