"""Absolute trajectory error (ATE, APE) and relative pose error (RPE) against the ground truth."""

from dataclasses import dataclass

import numpy as np

from slamlab.evaluation.time_association import TOLERANCE, associated
from slamlab.geometry import between, wrap


@dataclass(frozen=True)
class TrajectoryError:
    """Root mean square (RMSE) and maximum of a trajectory error [m, rad] over the compared poses or
    steps, whose number is ``count``; ``of`` also counts those without a true pose at their time."""

    count: int
    translation: float
    translation_max: float
    rotation: float
    rotation_max: float
    of: int


def absolute_error(estimate, truth, tolerance=TOLERANCE):
    """Compute the absolute trajectory error (ATE, APE) of poses associated by time, with the first
    poses aligned (not by least squares, Umeyama): e_i = (x*_0⁻¹ x*_i)⁻¹ (x_0⁻¹ x_i). Returns a
    TrajectoryError. Raises ValueError if the times do not match, with the reason: unit, epoch,
    offset, not ascending.

    ``tolerance`` is the most that the times of a pair of poses differ [s].
    """
    estimated, true = _paired_poses(estimate, truth, tolerance)
    errors = between(between(true[0], true), between(estimated[0], estimated))
    return _statistics(errors, len(estimate))


def relative_error(estimate, truth, steps=1, tolerance=TOLERANCE):
    """Compute the relative pose error (RPE) over k steps of poses associated by time: e_i = (x*_i⁻¹
    x*_{i+k})⁻¹ (x_i⁻¹ x_{i+k}). Returns a TrajectoryError. Raises ValueError if the times do not
    match, see :func:`absolute_error`, or for too few poses.

    ``steps`` is k.
    """
    estimated, true = _paired_poses(estimate, truth, tolerance)
    if not 1 <= steps < len(true):
        raise ValueError(f"steps must be from 1 to {len(true) - 1} for {len(true)} poses")
    errors = between(
        between(true[:-steps], true[steps:]), between(estimated[:-steps], estimated[steps:])
    )
    return _statistics(errors, len(estimate) - steps)


def _paired_poses(estimate, truth, tolerance):
    if truth is None:
        raise ValueError("there is no ground truth: use relations_error with trusted relations")
    names = "the estimate", "the truth"
    first, second = associated(estimate.times, truth.times, tolerance, names).T
    return estimate.poses[first], truth.poses[second]


def _statistics(errors, of):
    distance, turn = np.hypot(errors[:, 0], errors[:, 1]), np.abs(wrap(errors[:, 2]))
    return TrajectoryError(
        len(errors),
        float(np.sqrt(np.mean(distance**2))),
        float(distance.max()),
        float(np.sqrt(np.mean(turn**2))),
        float(turn.max()),
        of,
    )
