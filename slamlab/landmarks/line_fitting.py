"""Line fitting by weighted total least squares: Σ e² / σ² with e = p_x cos α + p_y sin α − ρ
(Hessian normal form)."""

from dataclasses import dataclass
from functools import cached_property
from math import atan2, cos, sin

import numpy as np

from slamlab.geometry import wrap
from slamlab.models.parameters import SensorModel

ITERATIONS = 3  # of the maximum-likelihood fit
MAX_RANGE = 1e7  # a larger number means no return [m]
MIN_STEP = 1e-6  # least mean angle between beams: below it all have one bearing [rad]
MIN_VARIANCE_SHARE = 1e-12  # least variance of points along their line, as a share of t² [1]
MAX_EMPTY = 3  # beams without a return in a row by chance; more mean free space


@dataclass(frozen=True)
class Line:
    """Observation of a line landmark (wall) in a scan, in the robot's frame.

    Parameters
    ----------
    z : (2,) distance ρ' > 0 [m] and direction α' of the normal [rad]
    R : (2, 2) covariance of z
    ends : (2, 2) first and last observed point, counter-clockwise [m]
    beams : (n,) int, beams of the scan that hit it
    """

    z: np.ndarray
    R: np.ndarray
    ends: np.ndarray
    beams: np.ndarray

    @property
    def length(self):
        """Length of the observed segment [m]."""
        return float(np.hypot(*(self.ends[1] - self.ends[0])))


@dataclass(frozen=True)
class ScanPoints:
    """Points (n, 2) [m] of a scan with beams and noise. A full circle has ``total`` beams.
    ``floor`` is the minimum standard deviation [m], because walls are not perfectly flat."""

    points: np.ndarray
    angles: np.ndarray
    ranges: np.ndarray
    beams: np.ndarray
    total: int
    sensor: SensorModel
    floor: float

    def __len__(self):
        return len(self.ranges)

    @cached_property
    def after_gap(self):
        """Whether more than MAX_EMPTY beams without a return precede each point, (n,) bool."""
        return np.diff(self.beams, prepend=self.beams[-1:]) % self.total > MAX_EMPTY + 1

    @cached_property
    def _farthest(self):
        return 1.2 * self.ranges

    def variance(self, rows, rho, alpha):
        """Return the variance (k,) of points across a line [m²], at the range expected from the
        line; at the measured range, points that are too near would have larger weights."""
        c = np.cos(self.angles[rows] - alpha)
        # a beam parallel to the line, or away from it, has no expected range: limited
        r = np.minimum(max(rho, 0.0) / np.maximum(c, 1e-3), self._farthest[rows])
        along, across = self.sensor.sigma(r), self.sensor.bearing_sigma * r
        return (along * c) ** 2 + across**2 * (1 - c * c) + self.floor**2


def usable_beams(scan):
    """Return the indices of the valid beams of a scan; none if all beams have the same bearing."""
    beams = np.flatnonzero(scan.valid & np.isfinite(scan.angles) & (scan.ranges < MAX_RANGE))
    return beams if mean_step(scan) > MIN_STEP else beams[:0]


def mean_step(scan):
    """Return the mean absolute angle between beams of a scan [rad]; 0 for fewer than two beams."""
    angles = scan.angles[np.isfinite(scan.angles)]
    return float(np.abs(np.diff(angles)).mean()) if len(angles) > 1 else 0.0


def scan_points(scan, sensor, floor=0.002):
    """Return the ScanPoints of the valid beams of a scan."""
    beams = usable_beams(scan)
    angles, r = scan.angles[beams], scan.ranges[beams]
    points = np.column_stack([r * np.cos(angles), r * np.sin(angles)])
    total = max(len(scan.angles), round(2 * np.pi / max(mean_step(scan), MIN_STEP)))
    return ScanPoints(points, angles, r, beams, total, sensor, floor)


def total_least_squares(points):
    """Fit a line by total least squares (orthogonal regression). Equations (08.5) and (08.6).

    points : (n, 2) [m], at least two. Returns rho ≥ 0 [m] and alpha [rad].
    """
    centre = points.mean(axis=0)
    x, y = (points - centre).T
    alpha = 0.5 * atan2(-2 * (x @ y), y @ y - x @ x)
    return _outward(centre[0] * cos(alpha) + centre[1] * sin(alpha), alpha)


def fit(cloud, rows, start=None, iterations=ITERATIONS):
    """Fit a line to points of a scan by maximum likelihood, with R of Equation (08.8).

    Parameters
    ----------
    cloud : ScanPoints
    rows : (n,) int, at least two
    start : (2,) initial ρ, α, by default of total least squares
    iterations : int, at least one

    Returns
    -------
    z : (2,) ρ ≥ 0 [m], α [rad]
    R : (2, 2) its covariance, the inverse of Σ J Jᵀ / σ² with J = [1, −t]; infinite if all points
        coincide
    """
    points, angles = cloud.points[rows], cloud.angles[rows]
    rho, alpha = total_least_squares(points) if start is None else start
    for _ in range(iterations):
        c, s = cos(alpha), sin(alpha)
        weights = 1 / cloud.variance(rows, rho, alpha)
        residual, t = points @ [c, s] - rho, points @ [-s, c]
        total, first, second = weights.sum(), weights @ t, weights @ (t * t)
        expected = np.minimum(np.maximum(rho * np.tan(angles - alpha), t.min()), t.max())
        # the 2 × 2 linear system of the step
        b_rho, b_alpha = weights @ residual, weights @ (expected * residual)
        det = total * second - first * first
        if not det > MIN_VARIANCE_SHARE * total * second:
            return np.array(_outward(rho, alpha)), np.diag([np.inf, np.inf])
        rho += (second * b_rho - first * b_alpha) / det
        alpha += (first * b_rho - total * b_alpha) / det
    R = np.array([[second, first], [first, total]]) / det
    return np.array(_outward(rho, alpha)), R


def _outward(rho, alpha):
    """Return the same line with ρ ≥ 0."""
    if rho < 0:
        rho, alpha = -rho, alpha + np.pi
    return float(rho), float(wrap(alpha))
