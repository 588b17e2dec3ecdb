"""Odometry calibration (self-calibration) online: gains that wheels have in error all the time.

A wheel worn or misjudged errs alike on every metre. Taken for noise that leaves, where walls say
little, half of the error in every step; estimated as gains by a Kalman filter it goes.
"""

import numpy as np

from slamlab.estimators import odometry_drift
from slamlab.geometry import wrap

GATE = 16.3  # χ² of 3 degrees of freedom, of a match against the calibrated odometry
MIN_SIGMA = 0.03  # first σ of a gain at least, also of wheels said to be exact [1, 1, rad/m]
DRIFT = 0.005  # random walk of the gains from match to match, a share of their first σ [1]


class OdometryCalibration:
    """Motion since the last keyframe by calibrated odometry, and the gains that it learns.

    An increment (x, y, θ) of the length d is taken for ((1+a) x, (1+a) y, (1+b) θ + c d).

    Parameters
    ----------
    robot : RobotModel, whose errors are the first standard deviations of a, b and c, no less
        than ``MIN_SIGMA``

    ``gains`` is (a, b, c) [1, 1, rad/m], ``P`` its covariance; ``motion`` the increment since
    ``restart`` [m, m, rad].
    """

    def __init__(self, robot):
        self.robot, self.gains = robot, np.zeros(3)
        sigmas = robot.distance_error, robot.turn_error, robot.turn_per_metre
        self.P = np.diag(np.square(np.maximum(sigmas, MIN_SIGMA)))
        self._drift = DRIFT**2 * self.P
        self.restart()

    def restart(self):
        """Begin a new motion, from a keyframe on."""
        self.motion, self._Q, self._J = np.zeros(3), np.zeros((3, 3)), np.zeros((3, 3))

    def corrected(self, odometry):
        """Odometry increment (3,) by the gains as they are known now [m, m, rad]."""
        x, y, turn = odometry
        a, b, c = self.gains
        way = np.copysign(np.hypot(x, y), x)
        return np.array([(1 + a) * x, (1 + a) * y, wrap((1 + b) * turn + c * way)])

    def predict(self, odometry, reach):
        """Add an increment to the motion, its covariance and its derivative by the gains.

        Parameters
        ----------
        odometry : (3,) as the wheels gave it [m, m, rad]
        reach : float, how far the scans reach [m]
        """
        x, y, turn = odometry
        heading, before = self.motion[2], self.motion
        self.motion, self._Q = odometry_drift.predict(
            before, self._Q, self.corrected(odometry), self.robot, reach
        )
        c, s = np.cos(heading), np.sin(heading)
        A = np.eye(3)
        A[:2, 2] = before[1] - self.motion[1], self.motion[0] - before[0]
        way = np.copysign(np.hypot(x, y), x)
        B = np.array([[c * x - s * y, 0, 0], [s * x + c * y, 0, 0], [0, turn, way]])
        self._J = A @ self._J + B

    def update(self, pose, C):
        """Kalman update of the gains by a match's pose since the keyframe, with its covariance.

        Parameters
        ----------
        pose : (3,) [m, m, rad]
        C : (3, 3)
        """
        self.P = self.P + self._drift
        S = self._J @ self.P @ self._J.T + self._Q + C
        y = np.array([*(pose[:2] - self.motion[:2]), wrap(float(pose[2] - self.motion[2]))])
        S_inverse = np.linalg.inv(S)
        if y @ S_inverse @ y > GATE:
            return
        K = self.P @ self._J.T @ S_inverse
        self.gains = self.gains + K @ y
        P = self.P - K @ self._J @ self.P
        self.P = (P + P.T) / 2
