"""RANSAC line extraction: walls in a scan from line hypotheses, their inliers and outliers.

Smolec §2.4: pick a random reading, fit a line through it and its neighbours, count the inliers.
``THESIS`` has his numbers; they fail with range, since noise grows and his band does not. By
default the inlier band is the noise's own, and a wall grows from its first points along the
scan (region growing). This stands where others split and merge (split-and-merge).
"""

from dataclasses import dataclass
from math import cos, erf, exp, pi, sin, sqrt

import numpy as np

from slamlab.landmarks.line_fitting import Line, cloud, fit, total_least_squares

MAX_MISSES = 40  # hypotheses in a row that fail, then the search ends
MAX_GROWTHS = 8  # rounds of region growing at most; three or four reach the ends


@dataclass(frozen=True)
class Ransac:
    """Parameters of RANSAC line extraction: how hypotheses are made and when they are accepted.

    Parameters
    ----------
    window : int, neighbouring readings a hypothesis is made of
    min_inliers : int, inliers: so many of these have to lie in the band
    band : float, inlier threshold, half the band's width [m], or None: ``sigmas`` standard
        deviations of each point
    sigmas : float
    max_chi2 : float, largest mean square residual in units of its variance, when band is None
    grow : bool, whether the wall goes on beyond the window
    gap : float, widest hole of a wall that grows, if one beam goes through it; two end it [m]
    max_hidden : float, widest piece of a wall that things before it may hide, in gaps [1]
    min_length : float, least length of a wall [m]
    """

    window: int = 9
    min_inliers: int = 8
    band: float | None = None
    sigmas: float = 2.8
    max_chi2: float = 1.6
    grow: bool = True
    gap: float = 0.4
    max_hidden: float = 3.0
    min_length: float = 0.3

    def __post_init__(self):
        if not 3 <= self.min_inliers <= self.window:
            raise ValueError(
                f"min_inliers is from 3 to the window of {self.window}, not {self.min_inliers}"
            )
        if (self.band is not None and self.band <= 0) or self.sigmas <= 0 or self.max_chi2 <= 0:
            raise ValueError("band, sigmas and max_chi2 are above zero")


THESIS = Ransac(window=25, min_inliers=21, band=0.015, grow=False, min_length=0.0)
"""Smolec's parameters: 25 readings, 15 mm, at least 25 − 4."""


def lines(scan, sensor, rng, ransac=None):
    """Extract the lines of the walls in a scan by RANSAC.

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
    while misses < MAX_MISSES and free.sum() >= ransac.window:
        line, rows = _sample_and_grow(points, free, rng, ransac)
        if line is None:
            misses += 1
            continue
        misses = 0
        free[rows] = False
        found.append((line, rows))
    found.sort(key=lambda pair: -len(pair[1]))
    if ransac.grow:
        walls = _refit_without_shared(points, found, ransac)
    else:
        walls = [_fitted_wall(points, line, rows, rows, ransac) for line, rows in found]
    return [wall for wall in walls if wall.length >= ransac.min_length]


def _sample_and_grow(points, free, rng, ransac):
    """A hypothesis, grown: line (ρ, α) round a random point and its inliers' rows, or two None."""
    rows = np.flatnonzero(free)
    seed = rng.integers(len(rows))
    # readings are neighbours round the whole turn
    rows = rows[(seed + np.arange(ransac.window) - ransac.window // 2) % len(rows)]
    seed, line = rows[ransac.window // 2], total_least_squares(points.points[rows])
    residuals, band = _residuals(points, rows, line, ransac)
    rows = rows[np.abs(residuals) <= band]
    for _ in range(MAX_GROWTHS if ransac.grow else 0):
        if len(rows) < ransac.min_inliers:
            break
        before, (line, _) = rows, fit(points, rows, line, iterations=1)
        rows = _connected_inliers(points, free, line, seed, ransac)
        if np.array_equal(rows, before):
            break
    if len(rows) < ransac.min_inliers:
        return None, None
    if ransac.band is None:
        residuals, band = _residuals(points, rows, line, ransac)
        if np.mean((residuals / band) ** 2) * ransac.sigmas**2 > ransac.max_chi2:
            return None, None
    return line, rows


def _residuals(points, rows, line, ransac):
    """Residuals of points to a line (ρ, α), outward, and the inlier band: (k,), (k,) or () [m]."""
    rho, alpha = line
    residuals = points.points[rows] @ [cos(alpha), sin(alpha)] - rho
    if ransac.band is not None:
        return residuals, ransac.band
    return residuals, ransac.sigmas * np.sqrt(points.variance(rows, rho, alpha))


def _connected_inliers(points, free, line, seed, ransac):
    """The free inliers connected to a seed, both ways along a line, in the order of the beams.

    The wall ends where beams go through it. Where something stands before it, or nothing came
    back, it may go on.
    """
    beams = points.beams
    residuals, band = _residuals(points, slice(None), line, ransac)
    inliers = ((np.abs(residuals) <= band) & free).nonzero()[0]
    if not len(inliers):
        return inliers
    # begin opposite to the seed: no wall reaches round the robot to there
    opposite = beams.searchsorted((beams[seed] + points.total // 2) % points.total)
    turned = inliers.searchsorted(opposite)
    inliers = np.concatenate([inliers[turned:], inliers[:turned]])
    places = inliers - opposite  # in that order
    places[places < 0] += len(points)
    along = points.points[inliers] @ [-sin(line[1]), cos(line[1])]
    through = ((residuals > band) | points.after_gap).cumsum()
    passed = through[inliers]
    views = passed[1:] - passed[:-1]  # one may be noise
    if 0 < turned < len(inliers):
        views[len(inliers) - turned - 1] += through[-1]  # from the last beam to the first
    apart, neighbours = np.abs(along[1:] - along[:-1]), places[1:] - places[:-1] == 1
    holes = (views > 1) | (views == 1) & (apart > ransac.gap)
    ends = (holes | ~neighbours & (apart > ransac.max_hidden * ransac.gap)).nonzero()[0]
    nearest = np.abs(places - (seed - opposite) % len(points)).argmin()
    k = ends.searchsorted(nearest)
    first = ends[k - 1] + 1 if k else 0
    last = ends[k] + 1 if k < len(ends) else len(inliers)
    return inliers[first:last]


def _refit_without_shared(points, found, ransac):
    """Fit each wall again without the inliers that may be another's.

    Near a corner two walls want the same points. Who took them first would be turned by them, in
    every scan alike; that error would never average out. So they tell where a wall ends, but not
    how it stands. What wants hardly a point of its own is a wall that was found before.
    """
    all_points, kept, claims = np.ones(len(points), dtype=bool), [], []
    for line, rows in found:
        inliers = np.zeros(len(points), dtype=bool)
        inliers[_connected_inliers(points, all_points, line, rows[len(rows) // 2], ransac)] = True
        if np.count_nonzero(inliers & ~np.any(claims, axis=0)) >= ransac.min_inliers:
            kept.append(line)
            claims.append(inliers)
    unshared = np.sum(claims, axis=0) == 1
    return [
        _fitted_wall(points, line, np.flatnonzero(own), np.flatnonzero(inliers), ransac)
        for line, inliers in zip(kept, claims, strict=True)
        if np.count_nonzero(own := inliers & unshared) >= ransac.min_inliers
    ]


def _fitted_wall(points, start, rows, extent, ransac):
    """The Line fitted to the rows that are its own, as far as the points of its extent go."""
    z, R = fit(points, rows, start, iterations=2)
    rho, alpha = z
    normal, way = (np.array([np.cos(a), np.sin(a)]) for a in (alpha, alpha + np.pi / 2))
    along = points.points[extent] @ way
    ends = rho * normal + np.outer([along.min(), along.max()], way)
    if ransac.band is None:
        R = R * _selection_inflation(ransac.sigmas)
    return Line(z, R, ends, points.beams[np.sort(rows)])


def _selection_inflation(c):
    """Covariance inflation by selecting inliers: P(χ²₁ < c²) / P(χ²₃ < c²).

    The band of c σ goes with the line, so the points it gains on one side and loses on the other
    pull the line further to where it errs. As for every Σ ψ(e/σ) = 0 the variance is that of ψ over
    the square of its mean slope; for ψ(e) = e in the band both are P(|e| < c) − 2 c φ(c).
    """
    inside = erf(c / sqrt(2))
    return inside / (inside - c * sqrt(2 / pi) * exp(-c * c / 2))
