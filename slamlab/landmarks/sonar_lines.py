"""Line extraction from an ultrasonic scan by the sonar cone model, r(β) = ρ / cos u, |u| = max(0,
|β − α| − δ) (Leonard, Durrant-Whyte 1992). Edges and pillars also form a region of constant depth,
but only a wall follows the model beyond that region."""

import numpy as np

from slamlab.geometry import wrap
from slamlab.landmarks.line_fitting import Line, usable_beams

WINDOW = np.radians(20)  # beyond the region of constant depth, for the first iterations [rad]
REACH = np.radians(40)  # beyond the region of constant depth, for the later iterations [rad]
STARTS = 21  # initial directions α of the fit
ITERATIONS = 6  # of Gauss-Newton, two of them in the window
SIGMAS = 2.8  # inlier threshold, in standard deviations of a range [1]
MAX_CHI2 = 1.8  # largest mean square residual of the inliers, in units of their variance
MIN_INLIERS, MIN_SHARE = 5, 0.6  # least number of inliers, and share of inliers in the window
MIN_SLANT = np.radians(25)  # least range of slant angles: edges and pillars rarely reach it [rad]
MAX_SIGMA = np.radians(5)  # largest standard deviation of α of a usable line [rad]
INFLATION = 1.15  # of R for the selection of inliers, some of which are of other objects [1]
MAX_SHARED = 0.3  # largest share of a wall's beams that a better supported wall also uses [1]


def slant(beta, alpha, half_cone):
    """Compute the slant angle u between a wall's normal α and the echo of a beam β: β − α less the
    half cone [rad]. Equation (09.7)."""
    off = wrap(np.asarray(beta) - alpha)
    return np.sign(off) * np.maximum(0.0, np.abs(off) - half_cone)


def sonar_lines(scan, sensor, min_slant=MIN_SLANT):
    """Return the Lines of a scan, best supported first. The slants u of a line's inliers must cover
    at least ``min_slant`` [rad]."""
    beams = usable_beams(scan)
    if not len(beams):
        return []
    angles, ranges = scan.angles[beams], scan.ranges[beams]
    found = []
    for k in _local_minima(angles, ranges, sensor.half_cone):
        line = _wall(angles, ranges, beams, angles[k], sensor, min_slant)
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
    """Fit (ρ, α) by a Gauss-Newton step: return z (2,) and R = (Jᵀ W J)⁻¹, or None if Jᵀ W J is
    singular, with the Jacobian J = ∂r/∂(ρ, α) = [1, −ρ tan u] / cos u."""
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
    """Return the rows of ranges that are the shortest within half a cone."""
    apart = np.abs(wrap(angles[:, None] - angles))
    nearest = np.where(apart <= half_cone, ranges, np.inf).min(axis=1)
    return np.flatnonzero(ranges <= nearest)


def _wall(angles, ranges, beams, bearing, sensor, min_slant):
    """Return the Line around a local minimum of the ranges, or None."""
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
    if np.ptp(u) < min_slant or chi2 > MAX_CHI2 * (len(rows) - 2):
        return None
    return _as_line(z, R, u, beams[rows])


def _start(angles, ranges, bearing, sensor):
    """Return the initial (ρ, α): α from a grid, ρ by linear least squares."""
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
    """Return rows up to a slant angle, which of them are contiguous inliers, and whether all rows
    of the region of constant depth are inliers."""
    u = slant(angles, z[1], sensor.half_cone)
    rows = np.flatnonzero(np.abs(u) <= reach)
    rows = rows[np.argsort(wrap(angles[rows] - z[1]))]
    u, expected = u[rows], z[0] / np.cos(u[rows])
    inliers = np.abs(ranges[rows] - expected) <= SIGMAS * sensor.sigma(expected)
    whole = bool(inliers[u == 0].all())
    first = np.flatnonzero((u < 0) & ~inliers).max(initial=-1)
    last = np.flatnonzero((u > 0) & ~inliers).min(initial=len(rows))
    rank = np.arange(len(rows))
    return rows, inliers & (rank > first) & (rank < last), whole


def _as_line(z, R, u, beams):
    normal, direction = (np.array([np.cos(a), np.sin(a)]) for a in (z[1], z[1] + np.pi / 2))
    ends = z[0] * (normal + np.outer(np.tan([u.min(), u.max()]), direction))
    return Line(np.array([z[0], wrap(z[1])]), INFLATION * R, ends, np.sort(beams))
