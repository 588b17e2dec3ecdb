"""Preprocessing of point clouds for scan matching: order of beams, local line fits, and normals."""

from dataclasses import replace
from functools import cached_property
from math import cos, sin

import numpy as np
from scipy.spatial import cKDTree

from slamlab.scanmatching.beam_order import FULL_TURN, ordered_beams
from slamlab.scanmatching.centroids import ORIGIN, distant_centroid
from slamlab.scanmatching.local_line_fits import fit_cloud_lines, fit_scan_lines
from slamlab.scanmatching.match_result import check_cloud
from slamlab.scanmatching.quantiles import median

MAX_BEARING_GAP = 2.0  # a bearing farther from any return, in beam gaps, is out of view [1]
SECTORS_PER_BEAM = 2  # resolution of the table of nearest beams
MAX_RANGE_FACTOR = 10.0  # ranges beyond so many median ranges may be outliers [1]


class PointCloud:
    """A point cloud with line fits and normals, ready for scan registration.

    Parameters
    ----------
    x, y : (n,) points [m]
    fits : LineFits, the line at each point
    sigma : float, standard deviation across the lines [m]
    bearings : (n,) ascending [rad], of a scan from the origin; None for other clouds
    gap : float, usual angle between bearings [rad]
    rows : (n,) int, index of each point in the original cloud, or None
    spacing : float, of points without bearings [m]
    oriented : bool, the normals point to the sensor
    """

    def __init__(
        self, x, y, fits, sigma, *, bearings=None, gap=0.0, rows=None, spacing=0.0, oriented=False
    ):
        self.x, self.y, self.fits, self.sigma = x, y, fits, sigma
        self.bearings, self.gap, self.rows = bearings, gap, rows
        self.spacing, self.oriented = spacing, oriented

    def __len__(self):
        return len(self.x)

    @property
    def points(self):
        """The points (n, 2) [m]; those of a scan are in order of bearing."""
        return np.column_stack([self.x, self.y])

    def original_index(self, indices):
        """Return indices (k,) in the original cloud."""
        return indices if self.rows is None else self.rows[indices]

    @cached_property
    def ranges(self):
        """Distances (n,) from the origin [m]."""
        return np.sqrt(self.x * self.x + self.y * self.y)

    @cached_property
    def reach(self):
        """Root mean square range without outliers, which scales rotation to metres [m]."""
        r, farthest = self.ranges, MAX_RANGE_FACTOR * self.median_range or np.inf
        if r @ r > len(r) * farthest**2:
            r = r[r <= farthest]
        return max(float(np.sqrt(r @ r / len(r))), 1e-12)

    @cached_property
    def median_range(self):
        """Median distance from the origin [m]."""
        return median(self.ranges)

    @cached_property
    def point_spacing(self):
        """Distance between neighbouring points [m]; for a scan, at its median range."""
        return self.spacing if self.bearings is None else self.gap * self.median_range

    @cached_property
    def centre(self):
        """Centroid (2,) of a cloud that is far from the origin, otherwise the origin [m]."""
        return distant_centroid(self.x, self.y) if self.bearings is None else ORIGIN

    @cached_property
    def centred(self):
        """The PointCloud with its centroid as origin."""
        cx, cy = self.centre
        if self.centre == ORIGIN:
            return self
        fits = replace(self.fits, offset=self.fits.offset - self.fits.nx * cx - self.fits.ny * cy)
        kept = {"rows": self.rows, "spacing": self.spacing, "oriented": self.oriented}
        return PointCloud(self.x - cx, self.y - cy, fits, self.sigma, **kept)

    @cached_property
    def points_and_normals(self):
        """The points, then the normals (2, 2n): one matrix product rotates both."""
        return np.array([[self.x, self.fits.nx], [self.y, self.fits.ny]]).reshape(2, -1)

    @cached_property
    def tree(self):
        return cKDTree(self.points, balanced_tree=False)  # faster to build, queries as fast

    def associate(self, x, y):
        """Data association: index (k,) of the point at the same bearing (projective association)
        or, without bearings, of the nearest point, and whether the scan has a return near there."""
        if self.bearings is None:
            _, nearest = self.tree.query(np.column_stack([x, y]))
            return nearest, np.ones(len(x), dtype=bool)
        nearest, near, per_radian = self._bearing_lookup
        sector = ((np.arctan2(y, x) + np.pi) * per_radian).astype(np.intp)
        return nearest[sector], near[sector]

    @cached_property
    def _bearing_lookup(self):
        """The beam nearest to each sector, and whether it is near enough to the sector."""
        n, b = len(self), self.bearings
        count = SECTORS_PER_BEAM * n
        middles = (np.arange(count + 1) + 0.5) * (FULL_TURN / count) - np.pi
        # one more beam at either end closes the circle
        ring, beam = np.empty(n + 2), np.arange(-1, n + 1)
        ring[0], ring[1:-1], ring[-1] = b[-1] - FULL_TURN, b, b[0] + FULL_TURN
        beam[0], beam[-1] = n - 1, 0
        index = (0.5 * (ring[1:] + ring[:-1])).searchsorted(middles)
        near = np.abs(ring[index] - middles) < MAX_BEARING_GAP * self.gap
        return beam[index], near, count / FULL_TURN


def rotation(theta):
    """Return the rotation matrix (2, 2) of an angle [rad]."""
    c, s = cos(theta), sin(theta)
    return np.array([[c, -s], [s, c]])


def preprocess(points, name="cloud"):
    """Preprocess a point cloud for registration; points in order of bearing around the origin are
    treated as a scan. Returns a PointCloud. Raises ValueError for a wrong shape, fewer than 3
    points, or NaN.

    Parameters
    ----------
    points : (n, 2) [m], n >= 3, or a PointCloud, which is returned
    name : str, for error messages
    """
    if isinstance(points, PointCloud):
        return points
    points = check_cloud(points, name)
    x, y = np.ascontiguousarray(points.T)
    bearings = np.arctan2(y, x)
    beams = ordered_beams(bearings)
    # the origin itself has no bearing
    if beams is None or np.count_nonzero(x * x + y * y) < len(points):
        fits, sigma, spacing = fit_cloud_lines(points)
        return PointCloud(x, y, fits, sigma, spacing=spacing)
    rows, step, gap = beams
    if rows is not None:
        x, y, bearings = x[rows], y[rows], bearings[rows]
    closed = bearings[0] + FULL_TURN - bearings[-1] < 3 * gap
    fits, sigma = fit_scan_lines(x, y, np.sqrt(x * x + y * y), step, closed, gap)
    return PointCloud(x, y, fits, sigma, bearings=bearings, gap=gap, rows=rows, oriented=True)
