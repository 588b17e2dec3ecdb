"""Moving samples: to each its own draw of what odometry may have got wrong."""

import numpy as np

from slamlab import noise
from slamlab.geometry import compose


def moved(x, odometry, robot, rng):
    """Poses drawn from p(x_t | x_{t−1}, u): an arc whose length and turn are in error.

    To first order they spread with the covariance Q = W C Wᵀ that EKF-SLAM takes for the same
    odometry; a turn in error swings the chord by half.

    Parameters
    ----------
    x : (n, 3) [m, m, rad]
    odometry : (3,) motion in the frame of the pose before [m, m, rad]
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
    long, turned = _root(C) @ rng.standard_normal((2, len(x)))
    along = direction + turned / 2
    steps = (d + long) * np.cos(along), (d + long) * np.sin(along), turn + turned
    return compose(x, np.stack(steps, axis=-1))


def _root(C):
    """(2, 2) lower L with L Lᵀ = C, which may be singular."""
    first = np.sqrt(C[0, 0])
    across = C[0, 1] / first if first > 0 else 0.0
    return np.array([[first, 0.0], [across, np.sqrt(max(C[1, 1] - across**2, 0.0))]])
