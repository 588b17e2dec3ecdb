"""A cloud made ready to be matched: in order of bearing where it is a scan, with lines fitted."""

from functools import cached_property

import numpy as np
from scipy.spatial import cKDTree

from slamlab.scanmatching.fits import median, ordered_fits, scatter, unordered_fits
from slamlab.scanmatching.result import cloud

TURN = 2 * np.pi
UNSEEN = 2.0  # a bearing so many steps from any beam that came back was not seen
FINEST = 0.01  # noise is never less than this share of the points' spacing
FEWEST = 5  # points that make a scan
FINENESS = 2  # sectors a beam in which the nearest beam is looked up


class Surface:
    """Points of what a scanner saw, and the lines through them.

    Parameters
    ----------
    x, y : (n,) points [m]
    fits : Fits, the line at each
    sigma : float, standard deviation of the points across their lines [m]
    bearings : (n,) increasing [rad], where this is a scan seen from the origin, or None
    rows : (n,) int, where each point stood in the cloud it came from, or None for the same order
    spacing : float, of neighbouring points where there are no bearings [m]
    fronts : bool, the normals point to where the points were seen from: walls have two sides
    """

    def __init__(self, x, y, fits, sigma, bearings=None, rows=None, spacing=0.0, fronts=False):
        self.x, self.y, self.fits, self.sigma = x, y, fits, sigma
        self.bearings, self.rows, self.spacing, self.fronts = bearings, rows, spacing, fronts
        if bearings is not None:
            self.step = median(bearings[1:] - bearings[:-1])

    def __len__(self):
        return len(self.x)

    @property
    def points(self):
        """(n, 2) the points [m]; in order of bearing where there is one."""
        return np.column_stack([self.x, self.y])

    def row(self, place):
        """(k,) int, where the points at these places stood in the cloud they came from."""
        return place if self.rows is None else self.rows[place]

    @cached_property
    def ranges(self):
        """(n,) distances from the origin [m]."""
        return np.sqrt(self.x * self.x + self.y * self.y)

    @cached_property
    def reach(self):
        """Root mean square distance of the points from the origin [m]."""
        return max(float(np.sqrt(self.ranges @ self.ranges / len(self))), 1e-12)

    @cached_property
    def tree(self):
        """KD-tree of the points."""
        return cKDTree(self.points)

    def facing(self, x, y):
        """The point of this surface that each given one is to be laid on.

        In a scan it is the one at the same bearing: on the same wall, wherever on it, the distance
        across the wall is the same. In another cloud it is the nearest.

        Parameters
        ----------
        x, y : (k,) [m]

        Returns
        -------
        (k,) int and (k,) bool: the point's place, and whether this surface was seen there
        """
        if self.bearings is None:
            _, place = self.tree.query(np.column_stack([x, y]))
            return place, np.ones(len(x), dtype=bool)
        nearest, near, per_radian = self._compass
        sector = ((np.arctan2(y, x) + np.pi) * per_radian).astype(np.intp)
        return nearest[sector], near[sector]

    @cached_property
    def _compass(self):
        """The nearest beam in each of many sectors of the round, and whether it is near."""
        count = FINENESS * len(self)
        middles = (np.arange(count + 1) + 0.5) * (TURN / count) - np.pi
        # a beam more at either end closes the ring
        b = self.bearings
        ring = np.concatenate([b[-1:] - TURN, b, b[:1] + TURN])
        place = ((ring[1:] + ring[:-1]) / 2).searchsorted(middles)
        near = np.abs(ring[place] - middles) < UNSEEN * self.step
        return (place - 1) % len(self), near, count / TURN


def surface(points, name="cloud"):
    """A surface from a cloud.

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
    ValueError : the points are no cloud
    """
    if isinstance(points, Surface):
        return points
    points = cloud(points, name)
    x, y = np.ascontiguousarray(points.T)
    bearings = np.arctan2(y, x)
    rows = around(bearings)
    if rows is not None and points.any(axis=1).all():
        if len(rows):
            x, y, bearings = x[rows], y[rows], bearings[rows]
        return scan(x, y, bearings, rows if len(rows) else None)
    fits, spacing = unordered_fits(points)
    return Surface(x, y, fits, max(scatter(fits), FINEST * spacing), spacing=spacing)


def scan(x, y, bearings, rows=None):
    """A surface from points in order of bearing.

    Parameters
    ----------
    x, y, bearings : (n,) [m, m, rad]
    rows : see :class:`Surface`

    Returns
    -------
    Surface
    """
    made = Surface(x, y, None, 0.0, bearings, rows, fronts=True)
    r, over = made.ranges, bearings[0] + TURN - bearings[-1]
    made.fits, sigma = ordered_fits(x, y, r, made.step, over < 3 * made.step)
    made.sigma = max(sigma, FINEST * made.step * median(r))
    return made


def around(bearings):
    """The order in which bearings increase, where they go round once.

    Parameters
    ----------
    bearings : (n,) [rad]

    Returns
    -------
    (n,) int; empty where the order is already that; None where they go to and fro
    """
    if len(bearings) < FEWEST:
        return None
    steps = np.diff(bearings)
    rising = np.count_nonzero(steps > 0)
    if rising == len(steps):
        return np.empty(0, dtype=int)
    sense = 1 if 2 * rising > len(steps) else -1
    seams = np.flatnonzero(sense * steps <= 0)  # where the scan passes from +π to −π
    if len(seams) > 1:
        return None
    rows = np.roll(np.arange(len(bearings)), -int(seams[0]) - 1 if len(seams) else 0)[::sense]
    return rows if (np.diff(bearings[rows]) > 0).all() else None
