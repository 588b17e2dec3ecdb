"""Smolec's filter formulas as printed, each unless it is mended: A, H, J_xr, J_z, Q and R."""

from dataclasses import replace

import numpy as np

from slamlab.estimators.landmark_observations import measurement_noise
from slamlab.estimators.mak_slam import Q_arc
from slamlab.filters.landmark_models import POINTS
from slamlab.filters.mak import MAK
from slamlab.geometry import compose
from slamlab.models import noise

DEGREES = 180 / np.pi  # in a radian
MM = 1e-3  # of his state, in metres: the lever arm "1" where a range is missing
RANGE_ERROR, BEARING_SIGMA = 0.01, np.radians(1)  # the text's examples for (9)
MIN_BEARING_SIGMA = 0.01  # rad, of a foot: what the mended R takes at least


class ListingMAK(MAK):
    """EKF-SLAM on points whose lever arms are those of an angle in degrees.

    His A, §4.1, is [[1, 0, −Δy], [0, 1, Δx], [0, 0, 1]] with P's third row in degrees. Expressed in
    radians that is a displacement 180/π times as long.
    """

    def predict(self, x, Q):
        """EKF prediction, see :meth:`MAK.predict`, with A in degrees."""
        x = np.asarray(x, dtype=float)
        self._x[:2] -= (DEGREES - 1) * (x[:2] - self._x[:2])
        return super().predict(x, Q)


def make_filter(mends, P):
    """The filter: MAK on points, with what is not mended as printed.

    Parameters
    ----------
    mends : frozenset of str
    P : (3, 3) covariance of the pose at the start

    Returns
    -------
    MAK
    """
    if mends >= {"radians", "H", "J"}:
        return MAK(np.zeros(3), P)
    made = MAK if "radians" in mends else ListingMAK
    return made(np.zeros(3), P, kind=_model(mends))


def _model(mends):
    """The landmark model whose Jacobians H (2), J_xr (10), J_z (11) are printed or mended."""

    def H(x, p):
        H_r, H_p = (M.copy() for M in POINTS.H(x, p))
        if "H" not in mends:
            H_r[..., 1, 1] *= -1
            H_p[..., 1, 1] *= -1  # (3) takes it from (2)
        if "radians" not in mends:
            H_r[..., 1, :2] /= DEGREES
            H_p[..., 1, :] /= DEGREES
        return H_r, H_p

    def J(x, z):
        J_xr, J_z = (M.copy() for M in POINTS.J(x, z))
        if "J" not in mends:
            r = z[..., :1]
            J_xr[..., 2] = MM * np.array([-np.sin(x[2]), np.cos(x[2])])
            J_z[..., 1] *= MM / r
        if "radians" not in mends:
            J_xr[..., 2] *= DEGREES
            J_z[..., 1] *= DEGREES
        return J_xr, J_z

    return replace(POINTS, H=H, J=J)


def predict(filter, odometry, robot, c, mends):
    """Predict by odometry: x is moved alike, Q is (8)'s or the mended one.

    Parameters
    ----------
    filter : MAK
    odometry : (3,) motion in the robot's frame [m, m, rad]
    robot : RobotModel
    c : float, his tuning constant [1]
    mends : frozenset of str
    """
    pose, odometry = filter.pose, np.asarray(odometry, dtype=float)
    if not odometry.any():
        return
    moved = compose(pose, odometry)
    if "Q" in mends:
        Q = Q_arc(pose, odometry, robot)
    else:
        step = np.array([*(moved - pose)[:2], odometry[2]])
        Q = c * np.outer(step, step)
    filter.predict(moved, Q)


def R_feet(sensor, ranges, mends):
    """Measurement noise of feet at some ranges: (9), or the mended one.

    Parameters
    ----------
    sensor : SensorModel
    ranges : (m,) [m]
    mends : frozenset of str

    Returns
    -------
    (m, 2, 2) [m², rad²]
    """
    if "R" in mends:
        sigma = max(sensor.bearing_sigma, MIN_BEARING_SIGMA)
        return measurement_noise(replace(sensor, bearing_sigma=sigma), ranges)
    R = [noise.R(0.0, 0.0, BEARING_SIGMA, np.sqrt(RANGE_ERROR * MM * r)) for r in ranges]
    return np.reshape(R, (-1, 2, 2))
