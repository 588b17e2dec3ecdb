"""Submap (local map): scans merged and downsampled, the target of scan-to-map matching."""

import numpy as np

from slamlab.geometry import transform
from slamlab.scanmatching.local_line_fits import LineFits, median
from slamlab.scanmatching.surfaces import Surface


def build_submap(surfaces, poses):
    """Build a submap: scans at their poses merged into one point cloud, downsampled.

    Of each cell (voxel) the first point is kept. The cells are as wide as the scans' beams are
    apart where they usually hit. Lines are those fitted in each scan: fitted anew they would smear
    what two poses in error lay side by side.

    Parameters
    ----------
    surfaces : list of Surface, scans, at least one
    poses : (k, 3) [m, m, rad]

    Returns
    -------
    Surface
    """
    cell = max(median(np.array([s.step * median(s.ranges) for s in surfaces])), 1e-6)
    points = np.concatenate([transform(p, s.points) for s, p in zip(surfaces, poses, strict=True)])
    fits = [_transformed(s.fits, p) for s, p in zip(surfaces, poses, strict=True)]
    rows = np.floor(points / cell).astype(np.int64)
    _, first = np.unique(rows[:, 0] * 2**31 + rows[:, 1], return_index=True)
    first.sort()
    columns = (np.concatenate(column)[first] for column in zip(*fits, strict=True))
    x, y = np.ascontiguousarray(points[first].T)
    sigma = median(np.array([s.sigma for s in surfaces]))
    return Surface(x, y, LineFits(*columns), sigma, spacing=cell, oriented=True)


def _transformed(fits, pose):
    """Transform a scan's local lines by its pose; their columns."""
    tx, ty, theta = pose
    c, s = np.cos(theta), np.sin(theta)
    nx, ny = c * fits.nx - s * fits.ny, s * fits.nx + c * fits.ny
    offset = fits.offset + nx * tx + ny * ty
    return nx, ny, offset, fits.across_variance, fits.normal_variance, fits.good
