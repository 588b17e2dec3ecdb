"""Submap (local map): scans merged and downsampled, the target of scan-to-map matching."""

import numpy as np

from slamlab.scanmatching.local_line_fits import LineFits, median
from slamlab.scanmatching.surfaces import Surface, rotation


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
    cell = max(median(np.array([s.beam_spacing for s in surfaces])), 1e-6)
    columns = zip(*map(_transformed, surfaces, poses), strict=True)
    x, y, *lines = map(np.concatenate, columns)
    column, row = (np.floor(v / cell).astype(np.int64) for v in (x, y))
    _, first = np.unique(column * 2**31 + row, return_index=True)
    first.sort()
    fits = LineFits(*(v[first] for v in lines))
    sigma = median(np.array([s.sigma for s in surfaces]))
    return Surface(x[first], y[first], fits, sigma, spacing=cell, oriented=True)


def _transformed(surface, pose):
    """Transform a scan's points and local lines by its pose: x, y, and the columns of the fits."""
    tx, ty, theta = pose
    n, fits = len(surface), surface.fits
    x, y = rotation(theta) @ surface.points_and_normals
    nx, ny = x[n:], y[n:]
    offset = fits.offset + nx * tx + ny * ty
    unchanged = fits.across_variance, fits.normal_variance, fits.good
    return x[:n] + tx, y[:n] + ty, nx, ny, offset, *unchanged
