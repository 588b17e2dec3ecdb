"""Result of a scan match (pose, iterations, convergence), and checks of its point clouds."""

from dataclasses import dataclass
from math import isfinite

import numpy as np

MAX_COORDINATE = 1e7  # of a point: more is taken for a wrong unit [m]


@dataclass(frozen=True)
class Round:
    """One iteration (round) of a scan matcher: its pose and correspondences, to watch it converge.

    Parameters
    ----------
    pose : (3,) the source's frame in the target's, at which they were found [m, m, rad]
    error : float, mean residual: distance of the pairs [m]
    pairs : (k, 2) int, rows of an index into the source and one into the target
    """

    pose: np.ndarray
    error: float
    pairs: np.ndarray


@dataclass(frozen=True)
class Match:
    """Result of scan registration: the pose of a source point cloud in a target's frame.

    Parameters
    ----------
    pose : (3,) the source's frame in the target's [m, m, rad]; always finite
    rounds : int, iterations: how often pairs were fitted
    error : float, mean residual of the inlier pairs at this pose [m]; NaN without pairs
    share : float, inlier pairs as a share of the source's points [1]
    converged : bool, False where max_rounds or too few pairs ended it
    verdict : str, status in words: why it stopped
    history : tuple of Round, the initial guess and each iteration; empty unless asked for
    """

    pose: np.ndarray
    rounds: int
    error: float
    share: float
    converged: bool
    verdict: str
    history: tuple[Round, ...] = ()


def check_clouds(source, target, initial):
    """Validate two point clouds and an initial guess; return them as float arrays.

    Parameters
    ----------
    source, target : (n, 2), (m, 2) points [m]
    initial : (3,) [m, m, rad]

    Returns
    -------
    (n, 2), (m, 2), (3,) float arrays

    Raises
    ------
    ValueError : what is wrong with which of them
    """
    initial = check_pose(initial)
    return check_cloud(source, "source"), check_cloud(target, "target"), initial


def check_pose(initial):
    """Validate an initial guess: a float array (3,) of its own; ValueError if not finite."""
    initial = np.array(initial, dtype=float)
    if initial.shape != (3,) or not all(map(isfinite, initial.tolist())):
        raise ValueError(f"initial must be a finite pose [x, y, theta], got {initial.tolist()}")
    return initial


def check_cloud(points, name):
    """Validate a point cloud: a float array (n, 2); ValueError says what is wrong with it."""
    points = np.asarray(points, dtype=float)
    if points.ndim != 2 or points.shape[1] != 2:
        raise ValueError(f"{name} must have shape (n, 2), got {points.shape}")
    if len(points) < 3:
        raise ValueError(f"{name} has {len(points)} points, a match needs at least 3")
    farthest = np.abs(points).max()  # NaN where one is
    if not isfinite(farthest):
        raise ValueError(f"{name} holds NaN or infinite points: leave out beams without return")
    if farthest > MAX_COORDINATE:
        raise ValueError(f"{name} has points beyond {MAX_COORDINATE:.0e} m: is it in metres?")
    return points


def check_limits(tolerance, max_rounds, keep):
    """Validate the stopping and trimming options of both ICPs.

    Parameters
    ----------
    tolerance : float > 0 [m]
    max_rounds : int >= 1
    keep : float in (0, 1]

    Raises
    ------
    ValueError
    """
    if not tolerance > 0:
        raise ValueError(f"tolerance must be above 0 m, got {tolerance}")
    if max_rounds < 1:
        raise ValueError(f"max_rounds must be at least 1, got {max_rounds}")
    if not 0 < keep <= 1:
        raise ValueError(f"keep is a share of the pairs, above 0 and at most 1, got {keep}")
