"""Motion model sampling (the proposal): each particle draws its own odometry noise."""

import numpy as np

from slamlab.geometry import compose
from slamlab.models import noise


def sample_motion(x, odometry, robot, rng):
    """Sample the motion model p(x_t | x_{t−1}, u): an arc whose length and turn are in error.

    To first order they spread with the covariance Q = W C Wᵀ that EKF-SLAM takes for the same
    odometry; a turn in error swings the chord by half.

    Parameters
    ----------
    x : (n, 3) [m, m, rad]
    odometry : (3,) odometry increment in the frame of the pose before [m, m, rad]
    robot : RobotModel, how wrong the odometry is
    rng : numpy.random.Generator

    Returns
    -------
    (n, 3) [m, m, rad]
    """
    d, turn = np.hypot(odometry[0], odometry[1]), odometry[2]
    # who turns on the spot and slips goes where the arc would have led
    direction = np.arctan2(odometry[1], odometry[0]) if d > 0 else turn / 2
    C = noise.C_odometry((d, turn), robot.distance_error, robot.turn_error, robot.turn_per_metre)
    C += noise.C_wheels((d, turn), robot.slip, robot.base)
    distance_error, turn_error = _cholesky(C) @ rng.standard_normal((2, len(x)))
    along = direction + turn_error / 2
    length = d + distance_error
    steps = length * np.cos(along), length * np.sin(along), turn + turn_error
    return compose(x, np.stack(steps, axis=-1))


def _cholesky(C):
    """(2, 2) lower Cholesky factor L with L Lᵀ = C, which may be singular."""
    first = np.sqrt(C[0, 0])
    across = C[0, 1] / first if first > 0 else 0.0
    return np.array([[first, 0.0], [across, np.sqrt(max(C[1, 1] - across**2, 0.0))]])


moved = sample_motion  # name in the first edition
