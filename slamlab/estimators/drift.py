"""What a graph SLAM believes of odometry, whoever's it is."""

import numpy as np

from slamlab.estimators.mak import Q_arc
from slamlab.geometry import compose

OWN = 0.003, 0.03, 0.005, 0.05  # deviations: reaches, reaches a rad turned, rad, of the turn
UNTOLD = 1.0  # turn that standing still is taken for: it may be that nobody counts the wheels [rad]
SLACK = 0.03, 0.1, 0.15  # largest that any odometry may have: reaches, of the way, rad


def driven(pose, doubt, odometry, robot, reach):
    """Pose and covariance after a motion.

    Beside what the robot's model says, the scanner need not sit where the odometry's frame turns,
    and there may be no odometry at all.

    Parameters
    ----------
    pose : (3,) [m, m, rad]
    doubt : (3, 3)
    odometry : (3,) motion in the frame of the pose [m, m, rad]
    robot : RobotModel
    reach : float, how far the scans reach [m]

    Returns
    -------
    (3,), (3, 3)
    """
    after, A = compose(pose, odometry), np.eye(3)
    A[:2, 2] = pose[1] - after[1], after[0] - pose[0]
    turn = abs(odometry[2]) if odometry.any() else UNTOLD
    way = (OWN[0] + OWN[1] * turn) * reach
    own = np.diag(np.square([way, way, OWN[2] + OWN[3] * turn]))
    return after, A @ doubt @ A.T + Q_arc(pose, odometry, robot) + own


def slack(motion, reach):
    """(3, 3) covariance of what odometry may be off by for no reason that it knows of.

    Parameters
    ----------
    motion : (3,) since the last keyframe [m, m, rad]
    reach : float [m]
    """
    way = SLACK[0] * reach + SLACK[1] * np.hypot(motion[0], motion[1])
    return np.diag(np.square([way, way, SLACK[2]]))
