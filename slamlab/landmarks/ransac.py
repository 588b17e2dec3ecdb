"""RANSAC line extraction (Smolec §2.4; an alternative to split and merge), with region growing and
an inlier threshold derived from the noise."""

from dataclasses import dataclass
from math import cos, erf, exp, pi, sin, sqrt

import numpy as np

from slamlab.landmarks.line_fitting import Line, fit, scan_points, total_least_squares

MAX_MISSES = 40  # number of failed trials (hypotheses) in a row that ends the search
MAX_GROWTHS = 8  # iterations of region growing; three or four usually suffice


@dataclass(frozen=True)
class Ransac:
    """Parameters of RANSAC line extraction.

    Parameters
    ----------
    window : int, neighbouring points of a hypothesis
    min_inliers : int, least number of inliers among them
    band : float, inlier threshold [m]; None: ``sigmas`` standard deviations of each point
    sigmas : float
    max_chi2 : float, largest mean square residual in units of its variance, when band is None
    grow : bool, whether region growing extends the wall beyond the window
    gap : float, widest gap of a wall that one beam passes through; two beams end the wall [m]
    max_hidden : float, widest occluded part of a wall, in gaps [1]
    min_length : float, of a wall [m]
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
                f"min_inliers must be from 3 to the window of {self.window}, not {self.min_inliers}"
            )
        if (self.band is not None and self.band <= 0) or self.sigmas <= 0 or self.max_chi2 <= 0:
            raise ValueError("band, sigmas and max_chi2 must be above zero")


THESIS = Ransac(window=25, min_inliers=21, band=0.015, grow=False, min_length=0.0)
"""Smolec's parameters: windows of 25 points, 15 mm, at least 25 − 4 inliers."""


def lines(scan, sensor, rng, ransac=None):
    """Extract the lines of the walls in a scan by RANSAC. Returns a list of Line, the best
    supported first.

    Parameters
    ----------
    scan : Scan
    sensor : SensorModel
    rng : numpy.random.Generator
    ransac : Ransac, its defaults when None
    """
    ransac = ransac or Ransac()
    points = scan_points(scan, sensor)
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
    return [w for w in walls if w.length >= ransac.min_length and np.isfinite(w.R[0, 0])]


def _sample_and_grow(points, free, rng, ransac):
    """RANSAC hypothesis: a line (ρ, α) and its inliers (rows), or None and None."""
    rows = np.flatnonzero(free)
    seed = rng.integers(len(rows))
    # the first and the last beam of a full circle are neighbours
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
    """Return outward residuals to a line (ρ, α) and the inlier band: (k,), (k,) or () [m]."""
    rho, alpha = line
    residuals = points.points[rows] @ [cos(alpha), sin(alpha)] - rho
    if ransac.band is not None:
        return residuals, ransac.band
    return residuals, ransac.sigmas * np.sqrt(points.variance(rows, rho, alpha))


def _connected_inliers(points, free, line, seed, ransac):
    """Return the inliers among ``free`` points that are connected to a seed, in order of the beams:
    a wall ends where beams pass through its line, but not where it is occluded."""
    beams = points.beams
    residuals, band = _residuals(points, slice(None), line, ransac)
    inliers = ((np.abs(residuals) <= band) & free).nonzero()[0]
    if not len(inliers):
        return inliers
    # begin opposite to the seed: no wall extends that far around the robot
    opposite = beams.searchsorted((beams[seed] + points.total // 2) % points.total)
    turned = inliers.searchsorted(opposite)
    inliers = np.concatenate([inliers[turned:], inliers[:turned]])
    ranks = inliers - opposite  # in that order
    ranks[ranks < 0] += len(points)
    along = points.points[inliers] @ [-sin(line[1]), cos(line[1])]
    through = ((residuals > band) | points.after_gap).cumsum()
    passed = through[inliers]
    views = passed[1:] - passed[:-1]  # beams through the wall; one may be noise
    if 0 < turned < len(inliers):
        views[len(inliers) - turned - 1] += through[-1]  # from the last beam to the first
    apart, neighbours = np.abs(along[1:] - along[:-1]), ranks[1:] - ranks[:-1] == 1
    holes = (views > 1) | (views == 1) & (apart > ransac.gap)
    ends = (holes | ~neighbours & (apart > ransac.max_hidden * ransac.gap)).nonzero()[0]
    nearest = np.abs(ranks - (seed - opposite) % len(points)).argmin()
    k = ends.searchsorted(nearest)
    first = ends[k - 1] + 1 if k else 0
    last = ends[k] + 1 if k < len(ends) else len(inliers)
    return inliers[first:last]


def _refit_without_shared(points, found, ransac):
    """Fit each wall without inliers that it shares with other walls: they would bias the fit."""
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
    """Fit a Line to the points in ``rows``; its ends are those of the points in ``extent``."""
    z, R = fit(points, rows, start, iterations=2)
    rho, alpha = z
    normal, direction = (np.array([np.cos(a), np.sin(a)]) for a in (alpha, alpha + np.pi / 2))
    along = points.points[extent] @ direction
    ends = rho * normal + np.outer([along.min(), along.max()], direction)
    if ransac.band is None:
        R = R * _selection_inflation(ransac.sigmas)
    return Line(z, R, ends, points.beams[np.sort(rows)])


def _selection_inflation(c):
    """Return the covariance inflation that selecting inliers causes, P(χ²₁ < c²) / P(χ²₃ < c²): the
    variance of the M-estimator ψ(e) = e inside the threshold over its squared mean derivative."""
    inside = erf(c / sqrt(2))
    return inside / (inside - c * sqrt(2 / pi) * exp(-c * c / 2))
