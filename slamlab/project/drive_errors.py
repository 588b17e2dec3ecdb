"""How wrong an estimate is: relative errors, the map against the walls, honesty of the covariance.

None of it depends on the frame of the world, nor, but for the covariance, on the estimator's.
"""

import numpy as np
from scipy.spatial import cKDTree

from slamlab.evaluation.consistency import nees
from slamlab.geometry import between, compose, transform, wrap

LENGTHS = 1.0, 5.0, 20.0  # of way over which relative errors are taken [m]
ON_WALL = 0.05  # a wall has been mapped where a point lies so near [m]
OFF_WALL = 0.15  # a point of the map farther from all walls is wrong [m]
SAMPLE = 0.1  # walls are asked for at samples this far apart [m]
CELL = 0.05  # of points that fall into one cell of a grid one counts [m]
WORST_NEES = 1e4  # what one reading may contribute, and what a P that is no covariance does


def pairs(metres, length):
    """Index pairs of poses a length of way apart.

    Parameters
    ----------
    metres : (n,) way driven before each pose, growing [m]
    length : float [m]

    Returns
    -------
    (k,), (k,) ints; none where the drive is shorter
    """
    last = np.searchsorted(metres, metres + length - 1e-9)
    first = np.flatnonzero(last < len(metres))
    return first, last[first]


def relative_errors(estimate, truth, metres, length):
    """Relative translational errors over a length of way (KITTI's measure; frames do not matter).

    e = |t((x*_i⁻¹ x*_j)⁻¹ (x_i⁻¹ x_j))|  (Geiger et al. 2012)

    Parameters
    ----------
    estimate, truth : (n, 3) [m, m, rad]
    metres : (n,) way driven before each pose [m]
    length : float [m]

    Returns
    -------
    (k,) [m]; NaN where a pose of the estimate is
    """
    i, j = pairs(metres, length)
    with np.errstate(invalid="ignore"):
        error = between(between(truth[i], truth[j]), between(estimate[i], estimate[j]))
    return np.hypot(error[:, 0], error[:, 1])


def to_be_mapped(world):
    """What a map of a world should show, by the true poses: the walls, or the landmarks, seen.

    Parameters
    ----------
    world : HiddenWorld

    Returns
    -------
    (m, 2) samples of what was seen, (k, 2) of all there is [m]
    """
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
    """The rigid motion that lays an estimate on the truth, least squares over positions (Umeyama).

    Parameters
    ----------
    estimate, truth : (n, 3) [m, m, rad]; rows with NaN are left out

    Returns
    -------
    (3,) pose of the estimate's frame in the truth's; zero where nothing is finite
    """
    known = np.isfinite(estimate).all(axis=1)
    if not known.any():
        return np.zeros(3)
    p, q = estimate[known, :2], truth[known, :2]
    p0, q0 = p.mean(axis=0), q.mean(axis=0)
    a, b = p - p0, q - q0
    turn = np.arctan2(np.sum(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]), np.sum(a * b))
    return np.array([*(q0 - transform([0, 0, turn], p0[None])[0]), turn])


def map_score(points, walls, all_walls):
    """Map score: share of the walls seen with a point within 5 cm, less share of points off walls.

    Parameters
    ----------
    points : (n, 2) the map, laid on the truth [m]
    walls : (m, 2) samples of the walls that could be seen [m]
    all_walls : (k, 2) samples of all walls [m]

    Returns
    -------
    float, at most 1, not below 0
    """
    if not len(points) or not len(walls):
        return 0.0
    points = points[np.unique(np.floor(points / CELL), axis=0, return_index=True)[1]]
    mapped = np.isfinite(cKDTree(points).query(walls, distance_upper_bound=ON_WALL)[0])
    off = np.isinf(cKDTree(all_walls).query(points, distance_upper_bound=OFF_WALL)[0])
    return max(0.0, float(mapped.mean() - off.mean()))


def mean_nees(online, covariances, truth):
    """Mean NEES of the poses given online, over the readings with a claimed covariance.

    The first reading is left out: its pose is the origin by definition.

    Parameters
    ----------
    online : (n, 3) [m, m, rad], in the frame of the first pose
    covariances : (n, 3, 3); NaN where none is claimed
    truth : (n, 3) [m, m, rad]

    Returns
    -------
    float, 3 on average where the claims are true; NaN where there is no claim
    """
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
    """Points every so far along segments (n, 4) [m]."""
    counts = np.ceil(np.hypot(*(rows[:, 2:] - rows[:, :2]).T) / SAMPLE).astype(int)
    which = np.repeat(np.arange(len(rows)), counts)
    along = np.arange(len(which)) - np.repeat(np.cumsum(counts) - counts, counts)
    share = ((along + 0.5) / counts[which])[:, None]
    return (1 - share) * rows[which, :2] + share * rows[which, 2:]
