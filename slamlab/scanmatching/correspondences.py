"""Correspondences: data association of source points with lines of the target, and residuals."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from slamlab.scanmatching.preprocessing import rotation

MIN_NORMAL_COSINE = 0.7  # cosine of the largest angle between the normals of a correspondence [1]
MAX_ALONG_WALL = 4.0  # gate along the wall: distance of the nearest point, in spacings [1]


@dataclass
class Association:
    """Data association: for each source point, the target's point, whether it is ``in_view``,
    whether the correspondence passes the gates (``used``), the ``lines`` nx, ny, n · c [m], and the
    ``variance`` across them [m²]."""

    target_index: np.ndarray
    in_view: np.ndarray
    used: np.ndarray
    lines: tuple
    variance: np.ndarray


@dataclass
class Correspondences:
    """Correspondences at a pose: the source's ``points`` x, y in the target's frame [m], and the
    ``system`` (4, n) of J and r, whose product with J gives the normal equations."""

    pose: tuple
    association: Association
    points: tuple
    system: np.ndarray

    @property
    def J(self):
        """Jacobian (3, n) of the residuals with respect to [x, y, θ reach]."""
        return self.system[:3]

    @property
    def residuals(self):
        """Residuals (n,) across the target's lines (point-to-line distances) [m]."""
        return self.system[3]

    @cached_property
    def ranges(self):
        """Ranges (n,) from the target's origin [m]."""
        x, y = self.points
        return np.sqrt(x * x + y * y)


def find_correspondences(source, target, pose, association=None):
    """Find the Correspondences at a pose, with residuals r = n · (R p + t − c). The Association of
    a nearby pose may be reused, because finding it takes far longer than computing residuals."""
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
    return Correspondences(pose, association, points, system)


def _associate(source, target, points, normals):
    j, in_view = target.associate(*points)
    fits, own, (px, py) = target.fits, source.fits, points
    nx, ny, offset = fits.nx[j], fits.ny[j], fits.offset[j]
    cosine = nx * normals[0] + ny * normals[1]
    if not (source.oriented and target.oriented):
        cosine = np.abs(cosine)
    if target.bearings is None:  # no correspondence beyond the end of a wall
        away = (px - target.x[j]) ** 2 + (py - target.y[j]) ** 2
        across = np.abs(nx * px + ny * py - offset)
        in_view = away <= (across + MAX_ALONG_WALL * target.spacing) ** 2
    used = in_view & fits.good[j] & own.good & (cosine > MIN_NORMAL_COSINE)
    noise = source.sigma**2 + target.sigma**2
    variance = fits.across_variance[j] + own.across_variance + noise
    return Association(j, in_view, used, (nx, ny, offset), variance)
