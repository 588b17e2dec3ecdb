"""Odometry calibration: a Kalman filter estimates the gains of systematic odometry errors."""

import numpy as np

from slamlab.estimators import odometry_drift
from slamlab.geometry import wrap

GATE = 16.3  # χ² gate, 3 degrees of freedom: a match against the calibrated odometry
MIN_SIGMA = 0.03  # least initial σ of a gain, even without odometry noise [1, 1, rad/m]
DRIFT = 0.005  # random walk of the gains from match to match, as a share of their initial σ [1]


class OdometryCalibration:
    """Gains (a, b, c) [1, 1, rad/m] with covariance ``P``, and the ``motion`` (3,) since the last
    ``restart``. An increment (x, y, θ) of length d becomes ((1+a) x, (1+a) y, (1+b) θ + c d)."""

    def __init__(self, robot):
        self.robot, self.gains = robot, np.zeros(3)
        sigmas = robot.distance_error, robot.turn_error, robot.turn_per_metre
        self.P = np.diag(np.square(np.maximum(sigmas, MIN_SIGMA)))
        self._drift = DRIFT**2 * self.P
        self.restart()

    def restart(self):
        self.motion, self._Q, self._J = np.zeros(3), np.zeros((3, 3)), np.zeros((3, 3))

    def corrected(self, odometry):
        """Correct an odometry increment (3,) by the present gains."""
        x, y, turn = odometry
        a, b, c = self.gains
        length = np.copysign(np.hypot(x, y), x)
        return np.array([(1 + a) * x, (1 + a) * y, wrap((1 + b) * turn + c * length)])

    def predict(self, odometry, reach):
        """Add odometry (3,) to the motion; ``reach`` is the reach of the scans [m]."""
        x, y, turn = odometry
        heading, before = self.motion[2], self.motion
        self.motion, self._Q = odometry_drift.predict(
            before, self._Q, self.corrected(odometry), self.robot, reach
        )
        c, s = np.cos(heading), np.sin(heading)
        A = np.eye(3)
        A[:2, 2] = before[1] - self.motion[1], self.motion[0] - before[0]
        length = np.copysign(np.hypot(x, y), x)
        B = np.array([[c * x - s * y, 0, 0], [s * x + c * y, 0, 0], [0, turn, length]])
        self._J = A @ self._J + B

    def update(self, pose, C):
        """Correct the gains by a matched pose (3,) with covariance C (3, 3) (Kalman update)."""
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
