"""Line fitting: weighted total least squares of scan points, each weighed by its own noise.

Minimised are the residuals, Σ e² / σ², e = p_x cos α + p_y sin α − ρ, over distance ρ and direction
α of the normal. Unlike y = m x + c it has no walls it cannot fit.
"""

from dataclasses import dataclass
from functools import cached_property
from math import atan2, cos, sin

import numpy as np

from slamlab.geometry import wrap
from slamlab.models.parameters import SensorModel

ITERATIONS = 3  # of Gauss-Newton
MAX_EMPTY = 3  # empty beams in a row that happen by chance; more are a view into nothing


@dataclass(frozen=True)
class Line:
    """A line landmark (wall) as a scan shows it, in the robot's frame, with its covariance.

    Parameters
    ----------
    z : (2,) distance ρ' > 0 [m] and direction α' of the normal [rad], as ``models.h_line`` gives
    R : (2, 2) covariance of z
    ends : (2, 2) where the wall was seen to begin and to end, counter-clockwise [m]
    beams : (n,) int, which beams of the scan lie on it
    """

    z: np.ndarray
    R: np.ndarray
    ends: np.ndarray
    beams: np.ndarray

    @property
    def length(self):
        """Length of the wall segment that was seen [m]."""
        return float(np.hypot(*(self.ends[1] - self.ends[0])))


@dataclass(frozen=True)
class Cloud:
    """A point cloud: the points of a scan with their measurement noise.

    Parameters
    ----------
    points : (n, 2) in the robot's frame, in the order of the beams [m]
    angles, ranges : (n,) [rad], [m]
    beams : (n,) int, each point's beam in the scan
    total : int, beams of a whole turn
    sensor : SensorModel
    floor : float, least standard deviation of a point: walls are not that flat [m]
    """

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
        """(n,) bool, whether more than a few empty beams lie between a point and the one before."""
        return np.diff(self.beams, prepend=self.beams[-1:]) % self.total > MAX_EMPTY + 1

    @cached_property
    def _farthest(self):
        return 1.2 * self.ranges

    def variance(self, rows, rho, alpha):
        """(k,) measurement noise: variance of some points across a line they may lie on [m²].

        Noise grows with the range, so it is taken at the range where the beam meets the line: at
        the measured one, what happens to be too short would count for more.
        """
        c = np.cos(self.angles[rows] - alpha)
        # a beam along the line, or from behind it, meets it nowhere near
        r = np.minimum(max(rho, 0.0) / np.maximum(c, 1e-3), self._farthest[rows])
        along, across = self.sensor.sigma(r), self.sensor.bearing_sigma * r
        return (along * c) ** 2 + across**2 * (1 - c * c) + self.floor**2


def cloud(scan, sensor, floor=0.002):
    """The point cloud of a scan: its valid points with their measurement noise.

    Parameters
    ----------
    scan : Scan
    sensor : SensorModel
    floor : float, least standard deviation of a point [m]

    Returns
    -------
    Cloud
    """
    beams = np.flatnonzero(scan.valid)
    angles, ranges = scan.angles[beams], scan.ranges[beams]
    steps = np.abs(np.diff(scan.angles))
    total = max(len(scan.angles), round(2 * np.pi / steps.mean()) if len(steps) else 1)
    return Cloud(scan.points(), angles, ranges, beams, total, sensor, floor)


def total_least_squares(points):
    """Total least squares (orthogonal regression): the line of points of equal noise.

    Equations (08.5) and (08.6).

    Parameters
    ----------
    points : (n, 2) [m], at least two

    Returns
    -------
    rho, alpha : floats, rho ≥ 0 [m], [rad]
    """
    centre = points.mean(axis=0)
    x, y = (points - centre).T
    alpha = 0.5 * atan2(-2 * (x @ y), y @ y - x @ x)
    return _outward(centre[0] * cos(alpha) + centre[1] * sin(alpha), alpha)


def fit(cloud, rows, start=None, iterations=ITERATIONS):
    """Fit a line to points of a scan, each weighed by its own noise: maximum likelihood.

    By Gauss-Newton. A point errs along its beam, so it slides along a slanting wall as it
    leaves it; where on the wall it belongs its beam tells, not its range. Its R is equation (08.8).

    Parameters
    ----------
    cloud : Cloud
    rows : (n,) int, at least two
    start : (2,) ρ, α to begin with, by default that of total least squares
    iterations : int, at least one

    Returns
    -------
    z : (2,) ρ ≥ 0 [m], α [rad]
    R : (2, 2) its covariance, the inverse of Σ J Jᵀ / σ² with J = [1, −t]
    """
    points, angles = cloud.points[rows], cloud.angles[rows]
    rho, alpha = total_least_squares(points) if start is None else start
    for _ in range(iterations):
        c, s = cos(alpha), sin(alpha)
        weights = 1 / cloud.variance(rows, rho, alpha)
        residual, t = points @ [c, s] - rho, points @ [-s, c]
        total, first, second = weights.sum(), weights @ t, weights @ (t * t)
        expected = np.minimum(np.maximum(rho * np.tan(angles - alpha), t.min()), t.max())
        # the normal equations, two by two
        b_rho, b_alpha = weights @ residual, weights @ (expected * residual)
        det = total * second - first * first
        rho += (second * b_rho - first * b_alpha) / det
        alpha += (first * b_rho - total * b_alpha) / det
    R = np.array([[second, first], [first, total]]) / det
    return np.array(_outward(rho, alpha)), R


def _outward(rho, alpha):
    """The same line with its normal pointing away from the robot."""
    if rho < 0:
        rho, alpha = -rho, alpha + np.pi
    return float(rho), float(wrap(alpha))
