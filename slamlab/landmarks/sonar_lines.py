"""Sonar lines: walls in an ultrasonic scan, by the sonar cone model of their echoes.

A beam of half opening δ hears the nearest surface in its cone. Of a wall at distance ρ, its normal
in direction α, that is the foot of the perpendicular as long as the cone holds it: the range stays
ρ, a region of constant depth (Leonard, Durrant-Whyte 1992). Beyond, it is the cone's near edge:

    r(β) = ρ / cos u,  |u| = max(0, |β − α| − δ)

An edge, a pillar or a table leg echoes as a flat piece, too; behind it the range leaves faster
than a wall's. So a wall is only what follows the slope far enough.
"""

import numpy as np

from slamlab.geometry import wrap
from slamlab.landmarks.line_fitting import Line

WINDOW = np.radians(20)  # beyond the flat, in which a fit starts [rad]
REACH = np.radians(40)  # beyond the flat, to which a wall is followed [rad]
STARTS = 21  # directions α that a fit is started from
ITERATIONS = 6  # of Gauss-Newton, two of them in the window
SIGMAS = 2.8  # inlier threshold, standard deviations of a reading [1]
MAX_CHI2 = 1.8  # largest mean square residual of the inliers, in units of their variance
MIN_INLIERS, MIN_SHARE = 5, 0.6  # readings that fit, and the share of the window that they are
MIN_SLOPE = np.radians(25)  # above it hardly an edge or a pillar passes for a wall [rad]
MAX_SIGMA = np.radians(5)  # standard deviation of α above which a wall says nothing [rad]
INFLATION = 1.15  # of R: the line chooses its inliers, some of them of what stands beside it [1]
MAX_SHARED = 0.3  # of a wall's readings, that a better supported one holds already [1]


def slant(beta, alpha, half_cone):
    """Angle between a wall's normal and where its echo comes from: u = β − α less the half cone.

    Equation (09.7).

    Parameters
    ----------
    beta : (...,) directions of beams [rad]
    alpha : (...,) direction of the wall's normal [rad]
    half_cone : float, half opening angle of a beam; 0 of a lidar [rad]

    Returns
    -------
    (...,) u, 0 as long as the cone holds the foot of the perpendicular [rad]
    """
    off = wrap(np.asarray(beta) - alpha)
    return np.sign(off) * np.maximum(0.0, np.abs(off) - half_cone)


def sonar_lines(scan, sensor, min_slope=MIN_SLOPE):
    """Extract the lines of the walls in a scan of wide beams.

    Parameters
    ----------
    scan : Scan
    sensor : SensorModel, with its half cone
    min_slope : float, of slope that a wall has to be followed over, both sides together; less of it
        lets edges and pillars through [rad]

    Returns
    -------
    list of Line, the best supported first; ``beams`` are those that follow its echo
    """
    beams = np.flatnonzero(scan.valid)
    angles, ranges = scan.angles[beams], scan.ranges[beams]
    found = []
    for k in _local_minima(angles, ranges, sensor.half_cone):
        line = _wall(angles, ranges, beams, angles[k], sensor, min_slope)
        if line is not None:
            found.append(line)
    found.sort(key=lambda line: -len(line.beams))
    kept: list[Line] = []
    for line in found:
        shared = [len(np.intersect1d(line.beams, other.beams)) for other in kept]
        if max(shared, default=0) <= MAX_SHARED * len(line.beams):
            kept.append(line)
    return kept


def fit_cone(angles, ranges, sensor, alpha, rho):
    """One Gauss-Newton step of (ρ, α) by least squares: normal equations of the cone model.

    J = ∂r/∂(ρ, α) = [1, −ρ tan u] / cos u, weights 1/σ² at the range that the model expects

    Parameters
    ----------
    angles, ranges : (n,) of the readings that are the wall's [rad], [m]
    sensor : SensorModel
    alpha, rho : floats, the line so far [rad], [m]

    Returns
    -------
    z : (2,) ρ [m], α [rad]
    R : (2, 2) its covariance (Jᵀ W J)⁻¹; None where the readings do not tell a line
    """
    u = slant(angles, alpha, sensor.half_cone)
    expected = rho / np.cos(u)
    J = np.column_stack([1 / np.cos(u), -expected * np.tan(u)])
    JtW = J.T / sensor.sigma(expected) ** 2
    (a, b), (_, c) = JtW @ J
    det = a * c - b * b
    if not det > 1e-9 * a * c:
        return np.array([rho, alpha]), None
    R = np.array([[c, -b], [-b, a]]) / det
    return [rho, alpha] + R @ JtW @ (ranges - expected), R


def _local_minima(angles, ranges, half_cone):
    """Rows of the readings that are the nearest within half a cone, either way."""
    apart = np.abs(wrap(angles[:, None] - angles))
    nearest = np.where(apart <= half_cone, ranges, np.inf).min(axis=1)
    return np.flatnonzero(ranges <= nearest)


def _wall(angles, ranges, beams, bearing, sensor, min_slope):
    """The Line round one local minimum, or None where what is there is no wall."""
    near = np.abs(wrap(angles - bearing)) <= sensor.half_cone + WINDOW
    z = _start(angles[near], ranges[near], bearing, sensor)
    for k in range(ITERATIONS):
        rows, inliers, _ = _followed(angles, ranges, z, sensor, WINDOW if k < 2 else REACH)
        if k < 2 and np.count_nonzero(inliers) < MIN_SHARE * np.count_nonzero(near):
            return None
        rows = rows[inliers]
        if len(rows) < MIN_INLIERS:
            return None
        z, R = fit_cone(angles[rows], ranges[rows], sensor, z[1], z[0])
        if R is None or not 0 < z[0] < sensor.range_max:
            return None
    rows, inliers, whole = _followed(angles, ranges, z, sensor, REACH)
    rows = rows[inliers]
    if not whole or len(rows) < MIN_INLIERS or R[1, 1] > MAX_SIGMA**2:
        return None
    u = slant(angles[rows], z[1], sensor.half_cone)
    expected = z[0] / np.cos(u)
    chi2 = np.sum(((ranges[rows] - expected) / sensor.sigma(expected)) ** 2)
    if np.ptp(u) < min_slope or chi2 > MAX_CHI2 * (len(rows) - 2):
        return None
    return _as_line(z, R, u, beams[rows])


def _start(angles, ranges, bearing, sensor):
    """The line (ρ, α) that a robust fit starts from: ρ is linear once α is chosen from a grid."""
    alphas = bearing + sensor.half_cone * np.linspace(-1, 1, STARTS)
    factor = 1 / np.cos(slant(angles, alphas[:, None], sensor.half_cone))
    rho = np.full((STARTS, 1), ranges.min())
    for _ in range(2):
        weights = 1 / sensor.sigma(rho * factor) ** 2
        weights *= np.abs(ranges - rho * factor) * np.sqrt(weights) < SIGMAS
        total = np.sum(weights * factor**2, axis=1, keepdims=True)
        better = np.sum(weights * factor * ranges, axis=1, keepdims=True)
        rho = np.where(total > 0, better / np.where(total > 0, total, 1), rho)
    cost = ((ranges - rho * factor) / sensor.sigma(rho * factor)) ** 2
    best = np.minimum(cost, SIGMAS**2).sum(axis=1).argmin()
    return np.array([rho[best, 0], alphas[best]])


def _followed(angles, ranges, z, sensor, reach):
    """Readings up to a slant, those that follow the wall without a break, whether all its flat do.

    Lost echoes are no readings, so they break nothing.
    """
    u = slant(angles, z[1], sensor.half_cone)
    rows = np.flatnonzero(np.abs(u) <= reach)
    rows = rows[np.argsort(wrap(angles[rows] - z[1]))]
    u, expected = u[rows], z[0] / np.cos(u[rows])
    inliers = np.abs(ranges[rows] - expected) <= SIGMAS * sensor.sigma(expected)
    whole = bool(inliers[u == 0].all())
    first = np.flatnonzero((u < 0) & ~inliers).max(initial=-1)
    last = np.flatnonzero((u > 0) & ~inliers).min(initial=len(rows))
    place = np.arange(len(rows))
    return rows, inliers & (place > first) & (place < last), whole


def _as_line(z, R, u, beams):
    """The Line as far as its echoes came from it."""
    normal, way = (np.array([np.cos(a), np.sin(a)]) for a in (z[1], z[1] + np.pi / 2))
    ends = z[0] * (normal + np.outer(np.tan([u.min(), u.max()]), way))
    return Line(np.array([z[0], wrap(z[1])]), INFLATION * R, ends, np.sort(beams))
