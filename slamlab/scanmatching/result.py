"""What a match gives back, and the checks on what goes into it."""

from dataclasses import dataclass

import numpy as np

FARTHEST = 1e7


@dataclass(frozen=True)
class Round:
    """One look of a matcher at its clouds, for watching it work.

    Parameters
    ----------
    pose : (3,) the source's frame in the target's, at which the pairs were found [m, m, rad]
    error : float, mean distance of the pairs [m]
    pairs : (k, 2) int, rows of an index into the source and one into the target
    """

    pose: np.ndarray
    error: float
    pairs: np.ndarray


@dataclass(frozen=True)
class Match:
    """How a source cloud lies in the frame of a target cloud.

    Parameters
    ----------
    pose : (3,) the source's frame in the target's [m, m, rad]; always finite
    rounds : int, how often pairs were fitted
    error : float, mean distance of the pairs in use at this pose [m]; NaN without pairs
    share : float, pairs in use as a share of the source's points [1]
    converged : bool, False where the pose is only the best there was when the matcher gave up
    verdict : str, why it stopped, in words
    history : tuple of Round, the start, every round's outcome; empty unless asked for
    """

    pose: np.ndarray
    rounds: int
    error: float
    share: float
    converged: bool
    verdict: str
    history: tuple[Round, ...] = ()


def checked(source, target, initial):
    """The clouds and the first guess as float arrays.

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
    initial = checked_pose(initial)
    return cloud(source, "source"), cloud(target, "target"), initial


def checked_pose(initial):
    """The first guess as a float array (3,) of its own; ValueError where it is no finite pose."""
    initial = np.array(initial, dtype=float)
    if initial.shape != (3,) or not np.isfinite(initial).all():
        raise ValueError(f"initial must be a finite pose [x, y, theta], got {initial.tolist()}")
    return initial


def cloud(points, name):
    """One cloud as a float array (n, 2); ValueError says what is wrong with it."""
    points = np.asarray(points, dtype=float)
    if points.ndim != 2 or points.shape[1] != 2:
        raise ValueError(f"{name} must have shape (n, 2), got {points.shape}")
    if len(points) < 3:
        raise ValueError(f"{name} has {len(points)} points, a match needs at least 3")
    if not np.isfinite(points).all():
        raise ValueError(f"{name} holds NaN or infinite points: leave out beams without return")
    if np.abs(points).max() > FARTHEST:
        raise ValueError(f"{name} has points beyond {FARTHEST:.0e} m: is it in metres?")
    return points


def limits(tolerance, max_rounds, keep):
    """Check what both matchers are told about stopping and trimming.

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
