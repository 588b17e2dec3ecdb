"""Errors of a trajectory against the truth: absolute, and relative over steps."""

from dataclasses import dataclass

import numpy as np

from slamlab.geometry import between, wrap
from slamlab.readings import Trajectory


@dataclass(frozen=True)
class TrajectoryError:
    """Root mean square and largest errors of a trajectory.

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
    """How far each pose is from the true one, both seen from their first pose.

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
    estimated, true = _poses(estimate, truth)
    return _summed(between(between(true[0], true), between(estimated[0], estimated)))


def relative_error(estimate, truth, steps=1):
    """How far the motion over some steps is from the true one: local error, drift left out.

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
    estimated, true = _poses(estimate, truth)
    if not 1 <= steps < len(true):
        raise ValueError(f"{len(true)} poses have no motion over {steps} steps")
    return _summed(
        between(
            between(true[:-steps], true[steps:]), between(estimated[:-steps], estimated[steps:])
        )
    )


def _poses(estimate: Trajectory, truth: Trajectory):
    if len(estimate) != len(truth) or len(truth) == 0:
        raise ValueError(
            f"{len(estimate)} estimated and {len(truth)} true poses cannot be compared one by one"
        )
    return estimate.poses, truth.poses


def _summed(errors):
    distance, turn = np.hypot(errors[:, 0], errors[:, 1]), np.abs(wrap(errors[:, 2]))
    return TrajectoryError(
        len(errors),
        float(np.sqrt(np.mean(distance**2))),
        float(distance.max()),
        float(np.sqrt(np.mean(turn**2))),
        float(turn.max()),
    )
