"""Normal estimation in a point cloud."""

import numpy as np
from scipy.spatial import cKDTree

from slamlab.scanmatching.adaptive_neighbourhoods import neighbourhoods_above_noise, principal_axes


def normals(points, neighbours=7, radius=1.0, flatness=0.5):
    """Estimate unit normals by PCA of nearest neighbours, φ = ½ atan2(2 s_xy, s_xx − s_yy). Returns
    (n, 2), rows of NaN where no line fits. Raises ValueError.

    Parameters
    ----------
    points : (n, 2) [m]
    neighbours : int, points of a line fit; more if so few are dominated by noise
    radius : float, farther neighbours are ignored [m]
    flatness : float, largest ratio of the standard deviations across and along the line [1]
    """
    points = np.asarray(points, dtype=float)
    if points.ndim != 2 or points.shape[1] != 2:
        raise ValueError(f"points must have shape (n, 2), got {points.shape}")
    if len(points) == 0:
        return np.empty((0, 2))
    tree = cKDTree(points)
    distances, indices = tree.query(points, k=range(1, neighbours + 1), distance_upper_bound=radius)
    inside = np.isfinite(distances)
    count = inside.sum(axis=1)
    weight = inside / count[:, None]
    # neighbours relative to their point: no cancellation in a cloud far from the origin
    apart = points[np.where(inside, indices, 0)] - points[:, None]
    apart -= np.einsum("nk,nki->ni", weight, apart)[:, None]
    x, y = apart[..., 0], apart[..., 1]
    axes = principal_axes(*(np.einsum("nk,nk->n", weight, p) for p in (x * x, y * y, x * y)))
    blocks = neighbourhoods_above_noise(tree, points, axes, neighbours, radius / 1.5)
    if blocks is None:
        return _across(*axes, count, flatness)
    return _across(*blocks.axes, blocks.count, flatness)[blocks.cell]


def _across(direction, low, high, count, flatness):
    """Return normals (n, 2) from the variances across and along lines."""
    line = (count >= 3) & (high > low) & (low <= flatness**2 * high)
    across = np.column_stack([-np.sin(direction), np.cos(direction)])
    across[~line] = np.nan
    return across
