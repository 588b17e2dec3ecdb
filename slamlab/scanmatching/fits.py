"""Lines fitted to each point's neighbours in a cloud, by the order of a scan's beams or by a tree.

A fit is the mean of its points and the main axis of their covariance; what spreads across the line
is the noise of the points, measured where they are.
"""

from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial import cKDTree

from slamlab.scanmatching.windows import Windows, windows_of

SMOOTH, OF_NORMAL = 0.3, 0.3853  # share of a scan that is wall; that quantile of |N(0, 1)|
WORST = 0.03  # no scanner's noise is a larger share of its ranges: more is clutter
FLAT = 0.25  # largest spread across a line as a share of that along it
TILT = 0.06  # how well a normal shall be known, which says how many points a line needs [rad]
LONG = 20.0  # standard deviations of noise that a line is long at least, to be called flat
FEWEST, MOST = 2, 100  # neighbours on either side
GRAZING = 7.0  # a gap so many times the way across a beam parts two surfaces, as 5 σ of noise do
UNORDERED = 9  # points of a line where no order of beams says which belong together
NEAR = 4.0  # a neighbour lies within so many times the median way to the next but one


@dataclass(frozen=True)
class Fits:
    """Lines through the neighbourhoods of n points.

    Parameters
    ----------
    nx, ny : (n,) unit normals n, those of a scan towards its scanner
    offset : (n,) n · c with the neighbours' mean c: the line is n · p = offset [m]
    across : (n,) variance of a point across its line [m²]
    tilt : (n,) variance of the normal's direction [rad²]
    good : (n,) bool, at least three points, and flat
    windows : Windows, which points are whose neighbours, where they stand in order; or None
    """

    nx: np.ndarray
    ny: np.ndarray
    offset: np.ndarray
    across: np.ndarray
    tilt: np.ndarray
    good: np.ndarray
    windows: Windows | None = None


def noise(r, step):
    """Standard deviation of a scan's ranges, from the scan alone.

    Along a straight wall 1/r is a sinusoid of the bearing, so 1/r₋ + 1/r₊ − 2 cos δ / r is zero but
    for noise: times r² it has the standard deviation √6 σ. The lower values are those of walls, the
    upper ones of corners and clutter.

    Parameters
    ----------
    r : (n,) ranges of neighbouring beams, n >= 3 [m]
    step : float δ, the angle between beams [rad]

    Returns
    -------
    float σ [m]
    """
    u = 1 / r
    bent = np.abs(r[1:-1] ** 2 * (u[:-2] + u[2:] - 2 * np.cos(step) * u[1:-1]))
    return quantile(bent, SMOOTH) / (np.sqrt(6) * OF_NORMAL)


def quantile(values, share):
    """The value above that share of an array that holds no NaN, quicker than numpy's."""
    place = int(share * len(values))
    return float(np.partition(values, place)[place])


def median(values):
    """The upper median of an array that holds no NaN."""
    return quantile(values, 0.5)


def ordered_fits(x, y, r, step, closed):
    """Lines through each point of a scan and its neighbours by bearing, none across a jump.

    As many neighbours 2k as it takes to know the normal to ``TILT``, σ √12 / (g (2k)^1.5) = TILT
    with noise σ and spacing g, and to be longer than the noise is wide.

    Parameters
    ----------
    x, y, r : (n,) points by bearing and their ranges [m]
    step : float, angle between beams [rad]
    closed : bool, the last beam is the first one's neighbour

    Returns
    -------
    Fits, and the float noise σ of the ranges [m]
    """
    n, middling = len(x), median(r)
    sigma = min(noise(r, step), WORST * middling)
    gaps = np.empty(n)  # from each point to the next
    gaps[:-1] = np.sqrt((x[1:] - x[:-1]) ** 2 + (y[1:] - y[:-1]) ** 2)
    gaps[-1] = np.hypot(x[0] - x[-1], y[0] - y[-1])
    # the gaps hold the noise, too: what lies across the beam does not
    rough = sigma / max(step * middling, 1e-12)
    k = round(min(max((rough * np.sqrt(12) / TILT) ** (2 / 3), LONG * rough) / 2, MOST))
    k = min(max(FEWEST, k), (n - 1) // 2)
    jump = gaps > GRAZING * step * r + 5 * sigma
    if not closed:
        jump[-1] = True

    windows = windows_of(jump, k)
    count = windows.count.astype(float)
    means = windows.sums(np.array((x, y, x * x, y * y, x * y))) / count
    fits = lines(count, *means, windows)
    return fits, max(sigma, scatter(fits))  # ranges in whole centimetres show no noise but scatter


def scatter(fits):
    """Standard deviation across the lines, of the half that is flattest [m]."""
    known = fits.across[fits.good]
    return np.sqrt(median(known)) if len(known) else 0.0


def unordered_fits(points):
    """Lines through each point and its nearest ones.

    Parameters
    ----------
    points : (n, 2) [m]

    Returns
    -------
    Fits, and the float median way from a point to the next but one [m]
    """
    k = min(UNORDERED, len(points))
    distances, indices = cKDTree(points).query(points, k=k)
    spacing = max(median(distances[:, 2]), 1e-9)
    inside = distances <= NEAR * spacing
    count = inside.sum(axis=1).astype(float)
    # seen from each point: a cloud far from the origin loses no digits
    x, y = ((points[indices] - points[:, None]) * inside[..., None]).transpose(2, 0, 1)
    found = lines(count, *(v.sum(axis=1) / count for v in (x, y, x * x, y * y, x * y)))
    offset = found.offset + found.nx * points[:, 0] + found.ny * points[:, 1]
    return replace(found, offset=offset), spacing


def lines(count, x, y, xx, yy, xy, windows=None):
    """Fits from the mean coordinates and products of ``count`` points each.

    φ = ½ atan2(2 s_xy, s_xx − s_yy) is the line's direction; the covariance's eigenvalues are the
    spreads along and across, the latter with count − 2 degrees of freedom.
    """
    s_xx, s_yy, s_xy = xx - x * x, yy - y * y, xy - x * y
    middle, half = (s_xx + s_yy) / 2, (s_xx - s_yy) / 2
    direction = 0.5 * np.arctan2(s_xy, half)
    half = np.sqrt(half * half + s_xy * s_xy)
    along = middle + half
    low = np.maximum(middle - half, 0.0)
    across = low * count / np.maximum(count - 2, 1)
    good = (count >= 3) & (low < FLAT**2 * along)
    tilt = across / (count * np.maximum(along, 1e-300))
    nx, ny = -np.sin(direction), np.cos(direction)
    offset = nx * x + ny * y
    if windows is not None:  # the scanner stands before its walls
        front = np.where(offset > 0, -1.0, 1.0)
        nx, ny, offset = front * nx, front * ny, front * offset
    return Fits(nx, ny, offset, across, tilt, good, windows)
