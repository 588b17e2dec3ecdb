"""Submap (local map) of several scans, the target of scan-to-map matching."""

import numpy as np

from slamlab.scanmatching.local_line_fits import LineFits
from slamlab.scanmatching.preprocessing import PointCloud, rotation
from slamlab.scanmatching.quantiles import median


def build_submap(clouds, poses):
    """Build a PointCloud of scans at poses (k, 3), with one point per cell. The side of a cell is
    the spacing of the points, or their noise if that is larger. The line fits of each scan are
    kept: new fits would average scans whose poses have errors."""
    sigma = median(np.array([s.sigma for s in clouds]))
    cell = max(median(np.array([s.point_spacing for s in clouds])), sigma, 1e-6)
    columns = zip(*map(_transformed, clouds, poses), strict=True)
    x, y, *lines = map(np.concatenate, columns)
    column, row = (np.floor(v / cell).astype(np.int64) for v in (x, y))
    _, first = np.unique(column * 2**31 + row, return_index=True)
    first.sort()
    fits = LineFits(*(v[first] for v in lines))
    oriented = all(s.oriented for s in clouds)
    return PointCloud(x[first], y[first], fits, sigma, spacing=cell, oriented=oriented)


def _transformed(cloud, pose):
    """Return a scan moved to a pose, as columns: x, y, and those of the line fits."""
    tx, ty, theta = pose
    n, fits = len(cloud), cloud.fits
    x, y = rotation(theta) @ cloud.points_and_normals
    nx, ny = x[n:], y[n:]
    offset = fits.offset + nx * tx + ny * ty
    unchanged = fits.across_variance, fits.normal_variance, fits.good
    return x[:n] + tx, y[:n] + ty, nx, ny, offset, *unchanged
