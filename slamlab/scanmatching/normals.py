"""Normal estimation: surface normals of a point cloud."""

import numpy as np
from scipy.spatial import cKDTree


def normals(points, neighbours=7, radius=1.0, flatness=0.5):
    """Estimate unit normals by a line fitted to each point's nearest neighbours (PCA).

    The line's direction is the main axis of the neighbours' covariance,
    φ = ½ atan2(2 s_xy, s_xx − s_yy); the normal stands across it.

    Parameters
    ----------
    points : (n, 2) [m]
    neighbours : int, how many points a line is fitted to, the point itself among them
    radius : float, neighbours farther than this are left out [m]
    flatness : float, largest spread across the line as a share of that along it [1]

    Returns
    -------
    (n, 2) unit normals, rows of NaN where fewer than 3 neighbours or no line

    Raises
    ------
    ValueError : when the points are not (n, 2)
    """
    points = np.asarray(points, dtype=float)
    if points.ndim != 2 or points.shape[1] != 2:
        raise ValueError(f"points must have shape (n, 2), got {points.shape}")
    if len(points) == 0:
        return np.empty((0, 2))
    distances, indices = cKDTree(points).query(
        points, k=range(1, neighbours + 1), distance_upper_bound=radius
    )
    inside = np.isfinite(distances)
    count = inside.sum(axis=1)
    weight = inside / count[:, None]
    # neighbours relative to their point: a cloud far from the origin loses no digits
    apart = points[np.where(inside, indices, 0)] - points[:, None]
    apart -= np.einsum("nk,nki->ni", weight, apart)[:, None]
    x, y = apart[..., 0], apart[..., 1]
    s_xx, s_yy, s_xy = (np.einsum("nk,nk->n", weight, p) for p in (x * x, y * y, x * y))
    direction = 0.5 * np.arctan2(2 * s_xy, s_xx - s_yy)
    middle, half = (s_xx + s_yy) / 2, np.hypot((s_xx - s_yy) / 2, s_xy)
    line = (count >= 3) & (half > 0) & (middle - half <= flatness**2 * (middle + half))
    across = np.column_stack([-np.sin(direction), np.cos(direction)])
    across[~line] = np.nan
    return across
