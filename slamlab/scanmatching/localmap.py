"""Several scans as one surface, to match the next with."""

import numpy as np

from slamlab.geometry import transform
from slamlab.scanmatching.fits import Fits, median
from slamlab.scanmatching.surfaces import Surface


def merged(surfaces, poses):
    """Scans at their poses as one cloud; where they show the same twice, the first is kept.

    The cells in which one point is kept are as wide as the scans' beams are apart where they
    usually hit. Lines are those fitted in each scan: fitted anew they would smear what two poses in
    error lay side by side.

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
    fits = [turned(s.fits, p) for s, p in zip(surfaces, poses, strict=True)]
    rows = np.floor(points / cell).astype(np.int64)
    _, first = np.unique(rows[:, 0] * 2**31 + rows[:, 1], return_index=True)
    first.sort()
    columns = (np.concatenate(column)[first] for column in zip(*fits, strict=True))
    x, y = np.ascontiguousarray(points[first].T)
    sigma = median(np.array([s.sigma for s in surfaces]))
    return Surface(x, y, Fits(*columns), sigma, spacing=cell, fronts=True)


def turned(fits, pose):
    """The columns of fits as seen from the frame in which their scan stands at a pose."""
    tx, ty, theta = pose
    c, s = np.cos(theta), np.sin(theta)
    nx, ny = c * fits.nx - s * fits.ny, s * fits.nx + c * fits.ny
    return nx, ny, fits.offset + nx * tx + ny * ty, fits.across, fits.tilt, fits.good
