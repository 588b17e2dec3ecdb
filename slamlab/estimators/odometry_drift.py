"""Odometry drift as additional process noise of graph SLAM, beyond the robot's model."""

import numpy as np

from slamlab.estimators.ekf_slam import Q_arc
from slamlab.geometry import compose

# standard deviations of an increment: position in shares of the reach, constant and per rad;
# heading in rad, constant and per rad
DRIFT_SIGMA = 0.003, 0.03, 0.005, 0.05
STANDSTILL_TURN = 1.0  # turn assumed for a zero increment, as without encoders [rad]
UNMODELLED_SIGMA = 0.03, 0.1, 0.15  # of any odometry: shares of reach and distance, rad


def predict(pose, P, odometry, robot, reach):
    """Predict the pose (3,) and its covariance (3, 3): P ← A P Aᵀ + Q; ``reach`` of the scans [m].

    Q is larger than in the robot's model, because the lidar may not be at the centre of rotation,
    and odometry may be missing.
    """
    after, A = compose(pose, odometry), np.eye(3)
    A[:2, 2] = pose[1] - after[1], after[0] - pose[0]
    turn = abs(odometry[2]) if odometry.any() else STANDSTILL_TURN
    distance = (DRIFT_SIGMA[0] + DRIFT_SIGMA[1] * turn) * reach
    extra = np.diag(np.square([distance, distance, DRIFT_SIGMA[2] + DRIFT_SIGMA[3] * turn]))
    return after, A @ P @ A.T + Q_arc(pose, odometry, robot) + extra


def unmodelled_covariance(motion, reach):
    """Return the covariance (3, 3) of odometry errors that the robot's model does not include."""
    distance = UNMODELLED_SIGMA[0] * reach + UNMODELLED_SIGMA[1] * np.hypot(motion[0], motion[1])
    return np.diag(np.square([distance, distance, UNMODELLED_SIGMA[2]]))
