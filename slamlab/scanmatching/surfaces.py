"""Point clouds preprocessed for scan matching: ordered by bearing if a scan, with local lines."""

from functools import cached_property
from math import cos, sin

import numpy as np
from scipy.spatial import cKDTree

from slamlab.scanmatching.local_line_fits import fit_cloud_lines, fit_scan_lines, median
from slamlab.scanmatching.match_result import check_cloud

FULL_TURN = 2 * np.pi  # [rad]
MAX_BEARING_GAP = 2.0  # steps between beams: a bearing farther from any return was not seen [1]
MIN_SCAN_POINTS = 5  # fewer are no scan
SECTORS_PER_BEAM = 2  # resolution of the table of nearest beams


class Surface:
    """A point cloud ready for scan registration: points, local lines with normals, and noise.

    Parameters
    ----------
    x, y : (n,) points [m]
    fits : LineFits, the line at each
    sigma : float, standard deviation of the points across their lines [m]
    bearings : (n,) increasing [rad], where this is a scan seen from the origin, or None
    rows : (n,) int, where each point stood in the cloud it came from, or None for the same order
    spacing : float, of neighbouring points where there are no bearings [m]
    oriented : bool, the normals point to where the points were seen from: walls have two sides
    """

    def __init__(self, x, y, fits, sigma, bearings=None, rows=None, spacing=0.0, oriented=False):
        self.x, self.y, self.fits, self.sigma = x, y, fits, sigma
        self.bearings, self.rows, self.spacing, self.oriented = bearings, rows, spacing, oriented
        if bearings is not None:
            self.step = median(bearings[1:] - bearings[:-1])

    def __len__(self):
        return len(self.x)

    @property
    def points(self):
        """Point cloud (n, 2) [m]; in order of bearing where there is one."""
        return np.column_stack([self.x, self.y])

    def original_index(self, indices):
        """Indices (k,) of these points in the cloud they came from."""
        return indices if self.rows is None else self.rows[indices]

    @cached_property
    def ranges(self):
        """Ranges (n,): distances from the origin [m]."""
        return np.sqrt(self.x * self.x + self.y * self.y)

    @cached_property
    def reach(self):
        """Reach: root mean square range of the points, by which turns are scaled to metres [m]."""
        return max(float(np.sqrt(self.ranges @ self.ranges / len(self))), 1e-12)

    @cached_property
    def beam_spacing(self):
        """Beam spacing: how far apart a scan's beams are where they usually hit [m]."""
        return self.step * median(self.ranges)

    @cached_property
    def points_and_normals(self):
        """Points, then normals: (2, 2n) columns that one product turns [m, 1]."""
        return np.array([[self.x, self.fits.nx], [self.y, self.fits.ny]]).reshape(2, -1)

    @cached_property
    def tree(self):
        """KD-tree of the points, for nearest neighbours."""
        return cKDTree(self.points, balanced_tree=False)  # quicker to build, as quick to ask

    def associate(self, x, y):
        """Data association: the point of this surface that corresponds to each given one.

        In a scan it is the one at the same bearing (projective): on the same wall, wherever on it,
        the distance across the wall is the same. In another cloud it is the nearest neighbour.

        Parameters
        ----------
        x, y : (k,) [m]

        Returns
        -------
        (k,) int and (k,) bool: the point's index, and whether this surface was seen there
        """
        if self.bearings is None:
            _, place = self.tree.query(np.column_stack([x, y]))
            return place, np.ones(len(x), dtype=bool)
        nearest, near, per_radian = self._bearing_lookup
        sector = ((np.arctan2(y, x) + np.pi) * per_radian).astype(np.intp)
        return nearest[sector], near[sector]

    @cached_property
    def _bearing_lookup(self):
        """Lookup table by bearing: the nearest beam in each sector, and whether it is near."""
        n, b = len(self), self.bearings
        count = SECTORS_PER_BEAM * n
        middles = (np.arange(count + 1) + 0.5) * (FULL_TURN / count) - np.pi
        # a beam more at either end closes the ring
        ring, beam = np.empty(n + 2), np.arange(-1, n + 1)
        ring[0], ring[1:-1], ring[-1] = b[-1] - FULL_TURN, b, b[0] + FULL_TURN
        beam[0], beam[-1] = n - 1, 0
        place = (0.5 * (ring[1:] + ring[:-1])).searchsorted(middles)
        near = np.abs(ring[place] - middles) < MAX_BEARING_GAP * self.step
        return beam[place], near, count / FULL_TURN


def rotation(theta):
    """Rotation matrix (2, 2) of an angle [rad]."""
    c, s = cos(theta), sin(theta)
    return np.array([[c, -s], [s, c]])


def surface(points, name="cloud"):
    """Preprocess a point cloud or scan for registration: order it and fit its local lines.

    A cloud whose points go round the origin in one sense, once at most, is taken for a scan seen
    from there.

    Parameters
    ----------
    points : (n, 2) [m], n >= 3, or a Surface, which is returned
    name : str, for errors

    Returns
    -------
    Surface

    Raises
    ------
    ValueError : wrong shape, fewer than 3 points, NaN
    """
    if isinstance(points, Surface):
        return points
    points = check_cloud(points, name)
    x, y = np.ascontiguousarray(points.T)
    bearings = np.arctan2(y, x)
    rows = _bearing_order(bearings)
    # the origin itself has no bearing
    if rows is not None and np.count_nonzero(x * x + y * y) == len(points):
        if len(rows):
            x, y, bearings = x[rows], y[rows], bearings[rows]
        return _scan_surface(x, y, bearings, rows if len(rows) else None)
    fits, sigma, spacing = fit_cloud_lines(points)
    return Surface(x, y, fits, sigma, spacing=spacing)


def _scan_surface(x, y, bearings, rows=None):
    """Surface of a scan: points in order of bearing, oriented normals.

    Parameters
    ----------
    x, y, bearings : (n,) [m, m, rad]
    rows : see :class:`Surface`

    Returns
    -------
    Surface
    """
    made = Surface(x, y, None, 0.0, bearings, rows, oriented=True)
    r, over = made.ranges, bearings[0] + FULL_TURN - bearings[-1]
    made.fits, made.sigma = fit_scan_lines(x, y, r, made.step, over < 3 * made.step)
    return made


def _bearing_order(bearings):
    """Order of a scan's bearings: the indices by which they increase, where they go round once.

    Parameters
    ----------
    bearings : (n,) [rad]

    Returns
    -------
    (n,) int; empty where the order is already that; None where they go to and fro
    """
    if len(bearings) < MIN_SCAN_POINTS:
        return None
    steps = bearings[1:] - bearings[:-1]
    rising = np.count_nonzero(steps > 0)
    if rising == len(steps):
        return np.empty(0, dtype=int)
    sense = 1 if 2 * rising > len(steps) else -1
    seams = np.flatnonzero(sense * steps <= 0)  # where the scan passes from +π to −π
    if len(seams) > 1:
        return None
    rows = np.roll(np.arange(len(bearings)), -int(seams[0]) - 1 if len(seams) else 0)[::sense]
    return rows if (np.diff(bearings[rows]) > 0).all() else None
