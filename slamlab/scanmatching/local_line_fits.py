"""Local line fitting: normals of a point cloud, and the range noise of a scan."""

from dataclasses import dataclass, replace
from math import cos, hypot, sqrt

import numpy as np
from scipy.spatial import cKDTree

from slamlab.scanmatching.adaptive_neighbourhoods import neighbourhoods_above_noise
from slamlab.scanmatching.quantiles import median, quantile

WALL_QUANTILE, NORMAL_QUANTILE = 0.3, 0.3853  # share of wall points; its |N(0, 1)| quantile
MIN_NOISE_SHARE = 0.01  # least noise as a share of the points' spacing [1]
MAX_NOISE_SHARE = 0.03  # largest noise as a share of the range: more is clutter [1]
MAX_FLATNESS = 0.25  # largest ratio of the standard deviations across and along a line [1]
NORMAL_SIGMA = 0.06  # desired standard deviation of a normal, which sets the window's width [rad]
MIN_LENGTH = 20.0  # least length of a line, in standard deviations of the noise [1]
# neighbours on either side: least, most, and a share of all points if that is more [1]
MIN_NEIGHBOURS, MAX_NEIGHBOURS, MAX_NEIGHBOUR_SHARE = 2, 100, 1 / 16
DISCONTINUITY_FACTOR = 7.0  # a larger gap, in beam spacings (and 5 σ), is a range discontinuity [1]
CLOUD_NEIGHBOURS = 9  # points of a line in a cloud without an order of beams
NEIGHBOUR_RADIUS = 4.0  # in median distances to the second nearest point [1]
MAX_RANGE_FACTOR = 1000.0  # a range of more median ranges is ignored [1]


@dataclass(frozen=True)
class Windows:
    """Windows over n points. ``ring`` contains the points' indices, with k more at either end;
    ``first`` and ``last`` are the positions in ``ring`` of the neighbours of each point."""

    ring: np.ndarray
    first: np.ndarray
    last: np.ndarray

    @property
    def count(self):
        """Number of points in each window (n,)."""
        return self.last - self.first

    def sums(self, values):
        """Return the sums (m, n) of values (m, n), as differences of cumulative sums."""
        running = np.zeros((len(values), len(self.ring) + 1))
        np.cumsum(values.take(self.ring, axis=1), axis=1, out=running[:, 1:])
        return running.take(self.last, axis=1) - running.take(self.first, axis=1)


@dataclass(frozen=True)
class LineFits:
    """A line fitted to the neighbourhood of each of n points: unit normals nx, ny (towards the
    sensor), ``offset`` n · c [m], variances across [m²] and of the normal's direction [rad²], and
    whether the line is ``good``."""

    nx: np.ndarray
    ny: np.ndarray
    offset: np.ndarray
    across_variance: np.ndarray
    normal_variance: np.ndarray
    good: np.ndarray
    windows: Windows | None = None

    def taken(self, rows):
        """Return the lines of some points (k,), without windows."""
        columns = self.nx, self.ny, self.offset, self.across_variance, self.normal_variance
        return LineFits(*(v[rows] for v in columns), self.good[rows])


def estimate_range_noise(r, step):
    """Estimate the standard deviation of a scan's ranges [m]. Along a wall, 1/r is a sinusoid of
    the bearing, so r² (1/r₋ + 1/r₊ − 2 cos δ / r) is noise with a standard deviation of √6 σ. The
    small values come from walls."""
    u = 1 / r
    bent = np.abs(r[1:-1] ** 2 * (u[:-2] + u[2:] - 2 * cos(step) * u[1:-1]))
    return quantile(bent, WALL_QUANTILE) / (sqrt(6) * NORMAL_QUANTILE)


def fit_scan_lines(x, y, r, step, closed, gap=None):
    """Return LineFits of points in order of bearing, with no fit across a discontinuity, and the
    range noise σ [m]. ``closed``: the scan is a full circle; ``gap``: the usual angle between
    bearings if it is not the mean step [rad].

    With 2k neighbours of spacing g, the normal has the standard deviation NORMAL_SIGMA = σ √12 / (g
    (2k)^1.5), and the line is MIN_LENGTH σ long.
    """
    n, ordered = len(x), np.sort(r)
    median_range = float(ordered[n // 2])
    limit = MAX_RANGE_FACTOR * median_range
    if ordered[-1] > limit:  # its square would cancel digits of the others
        x, y = (np.where(r > limit, 0.0, v) for v in (x, y))
    spacing = step * median_range
    sigma = min(estimate_range_noise(r, step), MAX_NOISE_SHARE * median_range)
    gaps = np.empty(n)  # from each point to the next
    gaps[:-1] = np.sqrt((x[1:] - x[:-1]) ** 2 + (y[1:] - y[:-1]) ** 2)
    gaps[-1] = hypot(x[0] - x[-1], y[0] - y[-1])
    # gaps contain the range noise, distances across the beam do not
    relative_noise = sigma / max(spacing, 1e-12)
    window = (relative_noise * sqrt(12) / NORMAL_SIGMA) ** (2 / 3)
    most = max(MAX_NEIGHBOURS, MAX_NEIGHBOUR_SHARE * n)
    k = round(min(max(window, MIN_LENGTH * relative_noise) / 2, most))
    k = min(max(MIN_NEIGHBOURS, k), (n - 1) // 2)
    jump = gaps > DISCONTINUITY_FACTOR * (gap or step) * r + 5 * sigma
    if not closed:
        jump[-1] = True

    windows = sliding_windows(jump, k)
    count = windows.count.astype(float)
    means = windows.sums(np.array((x, y, x * x, y * y, x * y))) / count
    fits = _lines_from_moments(count, *means, windows)
    # ranges in whole centimetres have no range noise by this estimate, but scatter
    return fits, max(sigma, scatter(fits), MIN_NOISE_SHARE * spacing)


def sliding_windows(jump, k):
    """Return windows of k neighbours to either side, split at discontinuities ``jump`` (n,), where
    another surface begins (segmentation)."""
    n = len(jump)
    ring = np.arange(-k, n + k)
    ring[:k] += n
    ring[n + k :] -= n
    cuts = np.concatenate(([0], jump[ring].nonzero()[0] + 1, [n + 2 * k]))
    length, first = cuts[1:] - cuts[:-1], np.arange(n)
    begin, end = (c.repeat(length)[k : n + k] for c in (cuts[:-1], cuts[1:]))
    return Windows(ring, np.maximum(first, begin), np.minimum(first + (2 * k + 1), end))


def scatter(fits):
    """Return the median standard deviation across the good lines [m]."""
    known = fits.across_variance[fits.good]
    return sqrt(median(known)) if len(known) else 0.0


def fit_cloud_lines(points):
    """Return the LineFits of points (n, 2) and their nearest neighbours, the noise σ across the
    lines, and the median distance to the second nearest point [m]."""
    tree, k = cKDTree(points), min(CLOUD_NEIGHBOURS, len(points))
    distances, indices = tree.query(points, k=k)
    spacing = max(median(distances[:, 2]), 1e-9)
    inside = distances <= NEIGHBOUR_RADIUS * spacing
    count, seen_from = inside.sum(axis=1).astype(float), points.T
    # relative to each point: no cancellation in a cloud far from the origin
    x, y = ((points[indices] - points[:, None]) * inside[..., None]).transpose(2, 0, 1)
    means = (v.sum(axis=1) / count for v in (x, y, x * x, y * y, x * y))
    found = _lines_from_moments(count, *means)
    shares = found.normal_variance * np.maximum(count - 2, 1)
    axes = np.arctan2(-found.nx, found.ny), shares, np.ones_like(shares)
    blocks = neighbourhoods_above_noise(tree, points, axes, k)
    if blocks is not None:
        found = _lines_from_moments(blocks.count, *blocks.means).taken(blocks.cell)
        seen_from = blocks.centre[:, blocks.cell]
    offset = found.offset + found.nx * seen_from[0] + found.ny * seen_from[1]
    found = replace(found, offset=offset)
    return found, max(scatter(found), MIN_NOISE_SHARE * spacing), spacing


def _lines_from_moments(count, x, y, xx, yy, xy, windows=None):
    """Fit lines (total least squares) from means, in direction φ = ½ atan2(2 s_xy, s_xx − s_yy)."""
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
    if windows is not None:  # the normals point to the sensor
        front = np.copysign(1.0, -offset)
        nx, ny, offset = front * nx, front * ny, front * offset
    return LineFits(nx, ny, offset, across, tilt, good, windows)
