"""Errors of an estimate: relative pose errors, map errors, NEES.

The errors do not depend on the frame of the world or, except for NEES, on that of the estimator."""

import numpy as np
from scipy.spatial import cKDTree

from slamlab.evaluation.consistency import nees
from slamlab.geometry import between, compose, transform, wrap

LENGTHS = 1.0, 5.0, 20.0  # distances travelled for relative pose errors [m]
ON_WALL = 0.05  # a wall sample is mapped if a point of the map is nearer than this [m]
OFF_WALL = 0.15  # a point of the map is wrong if it is farther from all walls [m]
SAMPLE = 0.1  # distance between samples of the walls [m]
CELL = 0.05  # cell size of the grid that thins the points of a map [m]
WORST_NEES = 1e4  # upper limit for one reading; also the value of a P that is no covariance


def pairs(metres, length):
    """Return indices, (k,) and (k,), of poses a given distance apart. metres : (n,) [m]."""
    last = np.searchsorted(metres, metres + length - 1e-9)
    first = np.flatnonzero(last < len(metres))
    return first, last[first]


def relative_errors(estimate, truth, metres, length):
    """Compute relative translational errors over a distance, (k,) [m]; NaN stays NaN.

    e = |t((x*_i⁻¹ x*_j)⁻¹ (x_i⁻¹ x_j))|  (KITTI; Geiger et al. 2012)
    estimate, truth : (n, 3) [m, m, rad]. metres : (n,) distance before each pose [m]."""
    i, j = pairs(metres, length)
    with np.errstate(invalid="ignore"):
        error = between(between(truth[i], truth[j]), between(estimate[i], estimate[j]))
    return np.hypot(error[:, 0], error[:, 1])


def walls_to_map(world):
    """Return points (m, 2) on the observed walls or landmarks, which a map should show, and
    points (k, 2) on all walls or landmarks."""
    if len(world.landmarks):
        seen = np.concatenate([reading.observations.ids for reading in world])
        return world.landmarks[np.unique(seen)], world.landmarks
    walls, hits, lidar = _samples(world.floor.outline()), [], world.family.lidar
    for pose in world.truth.poses:
        angles = pose[2] + lidar.angles
        ranges = world.floor.cast(pose[:2], angles)
        met = ranges < lidar.range_max
        rays = np.column_stack([np.cos(angles[met]), np.sin(angles[met])])
        hits.append(pose[:2] + ranges[met, None] * rays)
    near, _ = cKDTree(np.concatenate(hits)).query(walls, distance_upper_bound=SAMPLE)
    return walls[np.isfinite(near)], walls


def aligned(estimate, truth):
    """Return the pose (3,) that aligns an estimate with the truth: least squares (Umeyama).

    estimate, truth : (n, 3) [m, m, rad]; rows with NaN are ignored."""
    known = np.isfinite(estimate).all(axis=1)
    if not known.any():
        return np.zeros(3)
    p, q = estimate[known, :2], truth[known, :2]
    p0, q0 = p.mean(axis=0), q.mean(axis=0)
    a, b = p - p0, q - q0
    turn = np.arctan2(np.sum(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]), np.sum(a * b))
    return np.array([*(q0 - transform([0, 0, turn], p0[None])[0]), turn])


def map_score(points, walls, all_walls):
    """Return the share of observed walls with a point within 5 cm, minus the share of wrong points.

    points, walls (observed), all_walls : (·, 2) samples [m]. The result is from 0 to 1."""
    if not len(points) or not len(walls):
        return 0.0
    points = points[np.unique(np.floor(points / CELL), axis=0, return_index=True)[1]]
    mapped = np.isfinite(cKDTree(points).query(walls, distance_upper_bound=ON_WALL)[0])
    off = np.isinf(cKDTree(all_walls).query(points, distance_upper_bound=OFF_WALL)[0])
    return max(0.0, float(mapped.mean() - off.mean()))


def mean_nees(online, covariances, truth):
    """Compute the mean NEES of the online poses that have a covariance; NaN without covariances.

    online, truth : (n, 3) [m, m, rad]; covariances : (n, 3, 3). The first pose is ignored, because
    it is the origin by definition."""
    start = online[0] if np.isfinite(online[:1]).all() else np.zeros(3)
    true = compose(start, between(truth[0], truth))
    values = []
    for x, P, t in zip(online[1:], covariances[1:], true[1:], strict=True):
        if np.isfinite(P).all() and np.isfinite(x).all():
            e = np.array([x[0] - t[0], x[1] - t[1], wrap(float(x[2] - t[2]))])
            values.append(_nees(e, P))
    return float(np.mean(values)) if values else np.nan


def _nees(error, P):
    try:
        return min(float(nees(error, P)), WORST_NEES)
    except ValueError:  # P is no covariance
        return WORST_NEES


def _samples(rows):
    """Sample equidistant points along segments (n, 4) [m]."""
    counts = np.ceil(np.hypot(*(rows[:, 2:] - rows[:, :2]).T) / SAMPLE).astype(int)
    which = np.repeat(np.arange(len(rows)), counts)
    along = np.arange(len(which)) - np.repeat(np.cumsum(counts) - counts, counts)
    share = ((along + 0.5) / counts[which])[:, None]
    return (1 - share) * rows[which, :2] + share * rows[which, 2:]
