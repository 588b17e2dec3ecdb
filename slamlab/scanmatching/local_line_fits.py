"""Local line fitting in a point cloud, and a scan's range noise estimated from the scan itself.

Neighbours are found by the order of a scan's beams or by a KD-tree.
A fit is the mean of its points and the main axis of their covariance; what spreads across the line
is the noise of the points, measured where they are.
"""

from dataclasses import dataclass, replace
from math import cos, hypot, sqrt

import numpy as np
from scipy.spatial import cKDTree

from slamlab.scanmatching.neighbourhoods import Windows, sliding_windows

WALL_QUANTILE, NORMAL_QUANTILE = 0.3, 0.3853  # share of a scan that is wall; its |N(0, 1)| quantile
MIN_NOISE_SHARE = 0.01  # least noise as a share of the points' spacing [1]
MAX_NOISE_SHARE = 0.03  # largest noise as a share of the range: more is clutter [1]
MAX_FLATNESS = 0.25  # largest spread across a line as a share of that along it [1]
NORMAL_SIGMA = 0.06  # standard deviation wanted of a normal, which sets the window's width [rad]
MIN_LENGTH = 20.0  # least length of a line in standard deviations of the noise, to be called flat
MIN_NEIGHBOURS, MAX_NEIGHBOURS = 2, 100  # neighbours on either side
JUMP_FACTOR = 7.0  # a gap of so many beam spacings (and 5 σ of noise) is a range discontinuity [1]
CLOUD_NEIGHBOURS = 9  # points of a line in a cloud without an order of beams
NEIGHBOUR_RADIUS = 4.0  # in median distances to the next point but one [1]


@dataclass(frozen=True)
class LineFits:
    """Local lines with normals, one through the neighbourhood of each of n points.

    Parameters
    ----------
    nx, ny : (n,) unit normals n, those of a scan towards its scanner
    offset : (n,) n · c with the neighbours' mean c: the line is n · p = offset [m]
    across_variance : (n,) variance of a point across its line [m²]
    normal_variance : (n,) variance of the normal's direction [rad²]
    good : (n,) bool, at least three points, and flat
    windows : Windows, which points are whose neighbours, where they stand in order; or None
    """

    nx: np.ndarray
    ny: np.ndarray
    offset: np.ndarray
    across_variance: np.ndarray
    normal_variance: np.ndarray
    good: np.ndarray
    windows: Windows | None = None


def range_noise(r, step):
    """Estimate the measurement noise of a scan's ranges from the scan alone: standard deviation.

    Along a straight wall 1/r is a sinusoid of the bearing, so 1/r₋ + 1/r₊ − 2 cos δ / r is zero but
    for noise: times r² it has the standard deviation √6 σ. The lower values are those of walls, the
    upper ones of corners and clutter.

    Parameters
    ----------
    r : (n,) ranges of neighbouring beams, n >= 3 [m]
    step : float δ, the angle between beams [rad]

    Returns
    -------
    float σ [m]
    """
    u = 1 / r
    bent = np.abs(r[1:-1] ** 2 * (u[:-2] + u[2:] - 2 * cos(step) * u[1:-1]))
    return quantile(bent, WALL_QUANTILE) / (sqrt(6) * NORMAL_QUANTILE)


def quantile(values, share):
    """Quantile (upper) of an array that holds no NaN, quicker than numpy's."""
    # a scan's few hundred: sorting is quicker than partitioning where many are nearly equal
    ordered = np.array(values)
    ordered.sort()
    return float(ordered[int(share * len(ordered))])


def median(values):
    """Median (upper) of an array that holds no NaN."""
    return quantile(values, 0.5)


def fit_scan_lines(x, y, r, step, closed):
    """Fit lines to each point of a scan and its neighbours by bearing, none across a jump.

    As many neighbours 2k as it takes to know the normal to ``NORMAL_SIGMA``,
    σ √12 / (g (2k)^1.5) = NORMAL_SIGMA with noise σ and spacing g, and to be longer than the noise
    is wide.

    Parameters
    ----------
    x, y, r : (n,) points by bearing and their ranges [m]
    step : float, angle between beams [rad]
    closed : bool, the last beam is the first one's neighbour

    Returns
    -------
    LineFits, and the float noise σ of the ranges [m]
    """
    n, median_range = len(x), median(r)
    spacing = step * median_range
    sigma = min(range_noise(r, step), MAX_NOISE_SHARE * median_range)
    gaps = np.empty(n)  # from each point to the next
    gaps[:-1] = np.sqrt((x[1:] - x[:-1]) ** 2 + (y[1:] - y[:-1]) ** 2)
    gaps[-1] = hypot(x[0] - x[-1], y[0] - y[-1])
    # the gaps hold the noise, too: what lies across the beam does not
    relative_noise = sigma / max(spacing, 1e-12)
    window = (relative_noise * sqrt(12) / NORMAL_SIGMA) ** (2 / 3)
    k = round(min(max(window, MIN_LENGTH * relative_noise) / 2, MAX_NEIGHBOURS))
    k = min(max(MIN_NEIGHBOURS, k), (n - 1) // 2)
    jump = gaps > JUMP_FACTOR * step * r + 5 * sigma
    if not closed:
        jump[-1] = True

    windows = sliding_windows(jump, k)
    count = windows.count.astype(float)
    means = windows.sums(np.array((x, y, x * x, y * y, x * y))) / count
    fits = _lines_from_moments(count, *means, windows)
    # ranges in whole centimetres show no noise but scatter
    return fits, max(sigma, scatter(fits), MIN_NOISE_SHARE * spacing)


def scatter(fits):
    """Standard deviation of the residuals across the lines, of the flattest half [m]."""
    known = fits.across_variance[fits.good]
    return sqrt(median(known)) if len(known) else 0.0


def fit_cloud_lines(points):
    """Fit lines to each point of a cloud and its nearest neighbours, by a KD-tree.

    Parameters
    ----------
    points : (n, 2) [m]

    Returns
    -------
    LineFits, the float noise σ across them, and the median distance to the next point but one [m]
    """
    k = min(CLOUD_NEIGHBOURS, len(points))
    distances, indices = cKDTree(points).query(points, k=k)
    spacing = max(median(distances[:, 2]), 1e-9)
    inside = distances <= NEIGHBOUR_RADIUS * spacing
    count = inside.sum(axis=1).astype(float)
    # seen from each point: a cloud far from the origin loses no digits
    x, y = ((points[indices] - points[:, None]) * inside[..., None]).transpose(2, 0, 1)
    means = (v.sum(axis=1) / count for v in (x, y, x * x, y * y, x * y))
    found = _lines_from_moments(count, *means)
    offset = found.offset + found.nx * points[:, 0] + found.ny * points[:, 1]
    found = replace(found, offset=offset)
    return found, max(scatter(found), MIN_NOISE_SHARE * spacing), spacing


def _lines_from_moments(count, x, y, xx, yy, xy, windows=None):
    """Fit lines (total least squares) from the mean coordinates and products of ``count`` points.

    φ = ½ atan2(2 s_xy, s_xx − s_yy) is the line's direction; the covariance's eigenvalues are the
    spreads along and across, the latter with count − 2 degrees of freedom.
    """
    s_xx, s_yy, s_xy = xx - x * x, yy - y * y, xy - x * y
    mean, half = 0.5 * (s_xx + s_yy), 0.5 * (s_xx - s_yy)
    direction = 0.5 * np.arctan2(s_xy, half)
    half = np.sqrt(half * half + s_xy * s_xy)
    along = mean + half
    low = np.maximum(mean - half, 0.0)
    across = low * count / np.maximum(count - 2.0, 1.0)
    good = (count >= 3.0) & (low < MAX_FLATNESS**2 * along)
    tilt = across / (count * np.maximum(along, 1e-300))
    nx, ny = -np.sin(direction), np.cos(direction)
    offset = nx * x + ny * y
    if windows is not None:  # the scanner stands before its walls
        front = np.copysign(1.0, -offset)
        nx, ny, offset = front * nx, front * ny, front * offset
    return LineFits(nx, ny, offset, across, tilt, good, windows)
