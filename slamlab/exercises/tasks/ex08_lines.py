"""Lines (ρ, α) and points as stacks: distances, the least sum of squares, which are the same."""

import numpy as np

from slamlab.geometry import wrap

SLACK = 1e-4  # share of the least sum of squares: whoever searches instead of solving passes


def direction(alpha):
    """(..., 2) unit vectors that point to alpha (...)."""
    return np.stack([np.cos(alpha), np.sin(alpha)], axis=-1)


def distances(points, line):
    """(n, k) signed distances of points (n, k, 2) from lines (n, 2)."""
    normal = direction(line[:, 1])
    return np.einsum("nki,ni->nk", points, normal) - line[:, :1]


def scatter(points):
    """(n, 2, 2) sums of squares and products about the centroid."""
    off = points - points.mean(axis=1, keepdims=True)
    return np.einsum("nki,nkj->nij", off, off)


def is_least(points, line, slack=SLACK):
    """(n,) whether the sum of squares is the least of all lines: the least eigenvalue."""
    least = np.linalg.eigvalsh(scatter(points))[:, 0]
    return np.square(distances(points, line)).sum(axis=1) <= (1 + slack) * least + 1e-10


def outward(rho, alpha):
    """(n, 2) the same lines with ρ ≥ 0."""
    back = rho < 0
    return np.column_stack([np.abs(rho), wrap(alpha + np.pi * back)])


def same(got, want, tolerance=1e-4):
    """(n,) whether lines are the same numbers, but for whole turns."""
    off = np.abs([got[:, 0] - want[:, 0], wrap(got[:, 1] - want[:, 1])])
    return off.max(axis=0) < tolerance


def through_centroid(points, alpha):
    """(n, 2) lines of those directions through the centroids."""
    return outward(np.einsum("ni,ni->n", points.mean(axis=1), direction(alpha)), alpha)


def best_direction(S):
    """(n,) direction of the normal, from sums of squares and products."""
    return 0.5 * np.arctan2(-2 * S[:, 0, 1], S[:, 1, 1] - S[:, 0, 0])


def total(points):
    """(n, 2) lines of total least squares."""
    return through_centroid(points, best_direction(scatter(points)))
