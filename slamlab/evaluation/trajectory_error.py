"""Trajectory errors: absolute trajectory error (ATE, APE) and relative pose error (RPE).

The first poses are laid on each other; there is no least-squares alignment (Umeyama).
"""

from dataclasses import dataclass

import numpy as np

from slamlab.geometry import between, wrap
from slamlab.readings import Trajectory


@dataclass(frozen=True)
class TrajectoryError:
    """Trajectory error statistics: root mean square (RMSE) and largest.

    Parameters
    ----------
    count : int, poses or steps compared
    translation, translation_max : float [m]
    rotation, rotation_max : float [rad]
    """

    count: int
    translation: float
    translation_max: float
    rotation: float
    rotation_max: float


def absolute_error(estimate, truth):
    """Absolute trajectory error (ATE, APE): each pose against the true one, first poses aligned.

    e_i = (x*_0⁻¹ x*_i)⁻¹ (x_0⁻¹ x_i): an error in the first heading cannot hide or spoil the rest.

    Parameters
    ----------
    estimate, truth : Trajectory, pose by pose of the same times

    Returns
    -------
    TrajectoryError

    Raises
    ------
    ValueError : the trajectories differ in length or are empty
    """
    estimated, true = _matched_poses(estimate, truth)
    return _statistics(between(between(true[0], true), between(estimated[0], estimated)))


def relative_error(estimate, truth, steps=1):
    """Relative pose error (RPE): the motion over some steps against the true one, drift left out.

    e_i = (x*_i⁻¹ x*_{i+k})⁻¹ (x_i⁻¹ x_{i+k})

    Parameters
    ----------
    estimate, truth : Trajectory, pose by pose of the same times
    steps : int k, how many poses apart

    Returns
    -------
    TrajectoryError

    Raises
    ------
    ValueError : the trajectories differ in length or are too short
    """
    estimated, true = _matched_poses(estimate, truth)
    if not 1 <= steps < len(true):
        raise ValueError(f"{len(true)} poses have no motion over {steps} steps")
    return _statistics(
        between(
            between(true[:-steps], true[steps:]), between(estimated[:-steps], estimated[steps:])
        )
    )


def _matched_poses(estimate: Trajectory, truth: Trajectory):
    if len(estimate) != len(truth) or len(truth) == 0:
        raise ValueError(
            f"{len(estimate)} estimated and {len(truth)} true poses cannot be compared one by one"
        )
    return estimate.poses, truth.poses


def _statistics(errors):
    distance, turn = np.hypot(errors[:, 0], errors[:, 1]), np.abs(wrap(errors[:, 2]))
    return TrajectoryError(
        len(errors),
        float(np.sqrt(np.mean(distance**2))),
        float(distance.max()),
        float(np.sqrt(np.mean(turn**2))),
        float(turn.max()),
    )
