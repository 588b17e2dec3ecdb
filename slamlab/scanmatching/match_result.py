"""Result of a scan match, and checks of its input."""

from dataclasses import dataclass
from math import isfinite

import numpy as np

MAX_COORDINATE = 1e7  # of a point: more is assumed to be a wrong unit [m]


@dataclass(frozen=True)
class Iteration:
    """One iteration of a scan matcher.

    Parameters
    ----------
    pose : (3,) the source's frame in the target's [m, m, rad]
    error : float, mean distance of the correspondences [m]
    pairs : (k, 2) int, correspondences: rows of source and target
    """

    pose: np.ndarray
    error: float
    pairs: np.ndarray


@dataclass(frozen=True)
class Match:
    """Result of scan registration.

    Parameters
    ----------
    pose : (3,) the source's frame in the target's [m, m, rad]; always finite
    iterations : int, iterations
    error : float, mean residual of the inliers [m]; NaN without any
    inlier_ratio : float, inliers as a share of the source's points [1]
    converged : bool
    verdict : str, the reason why the iterations stopped
    history : tuple of Iteration, from the initial guess on, if requested
    """

    pose: np.ndarray
    iterations: int
    error: float
    inlier_ratio: float
    converged: bool
    verdict: str
    history: tuple[Iteration, ...] = ()


def check_pose(initial):
    """Return the initial guess as a new float array (3,). ValueError: the guess is not finite."""
    initial = np.array(initial, dtype=float)
    if initial.shape != (3,) or not all(map(isfinite, initial.tolist())):
        raise ValueError(f"initial must be a finite pose [x, y, theta], got {initial.tolist()}")
    return initial


def check_cloud(points, name):
    """Return the point cloud as a float array (n, 2). ValueError: the cloud is unusable."""
    points = np.asarray(points, dtype=float)
    if points.ndim != 2 or points.shape[1] != 2:
        raise ValueError(f"{name} must have shape (n, 2), got {points.shape}")
    if len(points) < 3:
        raise ValueError(f"{name} has {len(points)} points; a match needs at least 3")
    farthest = np.abs(points).max()  # NaN where one is
    if not isfinite(farthest):
        raise ValueError(f"{name} contains NaN or infinity: leave out beams without a return")
    if farthest > MAX_COORDINATE:
        beyond = np.count_nonzero(np.abs(points).max(axis=1) > MAX_COORDINATE)
        raise ValueError(
            f"{name} has {beyond} of {len(points)} points beyond {MAX_COORDINATE:.0e} m: "
            "leave out beams without a return, and use metres"
        )
    return points


def check_arguments(source, target, initial, tolerance, max_iterations, keep):
    """Return the clouds and the initial guess of an ICP as float arrays. Raises ValueError."""
    if not tolerance > 0:
        raise ValueError(f"tolerance must be above 0 m, got {tolerance}")
    if max_iterations < 1:
        raise ValueError(f"max_iterations must be at least 1, got {max_iterations}")
    if not 0 < keep <= 1:
        raise ValueError(
            f"keep must be a share of the correspondences above 0 and at most 1, got {keep}"
        )
    initial = check_pose(initial)
    return check_cloud(source, "source"), check_cloud(target, "target"), initial
