"""Correspondences of scan matching: which line of the target each source point is laid on.

Finding the lines costs far more than the residuals: at a pose near by they may be kept.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from slamlab.scanmatching.surfaces import rotation

MIN_NORMAL_COSINE = 0.7  # cosine of the largest angle between the two normals of a pair [1]
MAX_ALONG_WALL = 4.0  # gate along the wall: distance of the next point, in spacings [1]


@dataclass
class Association:
    """Data association: the line of the target that each point of the source is laid on.

    Parameters
    ----------
    target_index : (n,) int, the target's point for each of the source
    in_view : (n,) bool, the target was seen there
    used : (n,) bool, inliers of the gates: in view, both normals known and alike
    lines : three of (n,), unit normals nx and ny and the offsets n · c [m]
    variance : (n,) of the distance across the line by the noise of both clouds [m²]
    """

    target_index: np.ndarray
    in_view: np.ndarray
    used: np.ndarray
    lines: tuple
    variance: np.ndarray


@dataclass
class Pairs:
    """Correspondences: the source's points on the target's lines, with residuals and Jacobian.

    Parameters
    ----------
    pose : (3,) [m, m, rad]
    association : Association, made here or at a pose near by
    points : two of (n,), x and y of the source's points in the target's frame [m]
    system : (4, n) rows of J, the derivative of r with respect to [x, y, θ reach], then r: all in
        metres, and in one array, so that one product makes the normal equations
    """

    pose: tuple
    association: Association
    points: tuple
    system: np.ndarray

    @property
    def J(self):
        """Jacobian (3, n): derivative of the residuals with respect to [x, y, θ reach]."""
        return self.system[:3]

    @property
    def residuals(self):
        """Residuals r (n,): distances across the target's line [m]."""
        return self.system[3]

    @cached_property
    def ranges(self):
        """Ranges (n,) of the source's points from the target's origin [m]."""
        x, y = self.points
        return np.sqrt(x * x + y * y)


def find_correspondences(source, target, pose, association=None):
    """Find correspondences: each source point with a line of the target.

    r = n · (R p + t − c), with c and n of the line that faces p in the target.

    Parameters
    ----------
    source, target : Surface
    pose : (3,) floats [m, m, rad]
    association : Association to be kept, of a pose near by; None: a new one

    Returns
    -------
    Pairs
    """
    tx, ty, theta = pose
    x, y = rotation(theta) @ source.points_and_normals
    n = len(source)
    points = px, py = x[:n] + tx, y[:n] + ty
    if association is None:
        association = _associate(source, target, points, (x[n:], y[n:]))
    nx, ny, offset = association.lines
    system = np.empty((4, n))
    system[0], system[1] = nx, ny
    np.divide(x[:n] * ny - y[:n] * nx, source.reach, out=system[2])
    np.subtract(nx * px + ny * py, offset, out=system[3])
    return Pairs(pose, association, points, system)


def _associate(source, target, points, normals):
    """Associate the source's points and normals, in the target's frame, with the target's lines."""
    j, in_view = target.associate(*points)
    fits, own, (px, py) = target.fits, source.fits, points
    nx, ny, offset = fits.nx[j], fits.ny[j], fits.offset[j]
    cosine = nx * normals[0] + ny * normals[1]
    if not (source.oriented and target.oriented):
        cosine = np.abs(cosine)
    if target.bearings is None:  # beyond a wall's end there is nothing to be laid on
        away = (px - target.x[j]) ** 2 + (py - target.y[j]) ** 2
        across = np.abs(nx * px + ny * py - offset)
        in_view = away <= (across + MAX_ALONG_WALL * target.spacing) ** 2
    used = in_view & fits.good[j] & own.good & (cosine > MIN_NORMAL_COSINE)
    noise = source.sigma**2 + target.sigma**2
    variance = fits.across_variance[j] + own.across_variance + noise
    return Association(j, in_view, used, (nx, ny, offset), variance)
