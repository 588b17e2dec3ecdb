"""Odometry drift as process noise for graph SLAM, and errors that no robot's model tells."""

import numpy as np

from slamlab.estimators.mak_slam import Q_arc
from slamlab.geometry import compose

# standard deviations of an increment: shares of the reach, of it a rad turned; rad, of the turn
DRIFT_SIGMA = 0.003, 0.03, 0.005, 0.05
STANDSTILL_TURN = 1.0  # turn assumed at zero odometry: there may be no encoders [rad]
UNMODELLED_SIGMA = 0.03, 0.1, 0.15  # of any odometry: shares of reach and of distance, rad


def predict(pose, P, odometry, robot, reach):
    """Prediction of pose and covariance by an odometry increment: P ← A P Aᵀ + Q.

    Beside what the robot's model says, the scanner need not sit where the odometry's frame turns,
    and there may be no odometry at all.

    Parameters
    ----------
    pose : (3,) [m, m, rad]
    P : (3, 3) covariance
    odometry : (3,) motion in the frame of the pose [m, m, rad]
    robot : RobotModel
    reach : float, how far the scans reach [m]

    Returns
    -------
    (3,), (3, 3)
    """
    after, A = compose(pose, odometry), np.eye(3)
    A[:2, 2] = pose[1] - after[1], after[0] - pose[0]
    turn = abs(odometry[2]) if odometry.any() else STANDSTILL_TURN
    distance = (DRIFT_SIGMA[0] + DRIFT_SIGMA[1] * turn) * reach
    extra = np.diag(np.square([distance, distance, DRIFT_SIGMA[2] + DRIFT_SIGMA[3] * turn]))
    return after, A @ P @ A.T + Q_arc(pose, odometry, robot) + extra


def unmodelled_covariance(motion, reach):
    """(3, 3) covariance of odometry errors that the robot's model does not tell.

    Parameters
    ----------
    motion : (3,) since the last keyframe [m, m, rad]
    reach : float [m]
    """
    distance = UNMODELLED_SIGMA[0] * reach + UNMODELLED_SIGMA[1] * np.hypot(motion[0], motion[1])
    return np.diag(np.square([distance, distance, UNMODELLED_SIGMA[2]]))
