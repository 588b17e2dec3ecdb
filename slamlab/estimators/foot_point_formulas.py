"""Smolec's filter formulas, either as printed in the thesis or corrected."""

from dataclasses import replace

import numpy as np

from slamlab.estimators.ekf_slam import Q_arc
from slamlab.estimators.landmark_observations import measurement_noise
from slamlab.filters.ekf_slam_filter import MAK
from slamlab.filters.landmark_models import POINTS
from slamlab.geometry import compose
from slamlab.models import noise

DEGREES = 180 / np.pi  # per radian
MM = 1e-3  # unit of the thesis' state [m]: the lever arm "1" where a range is missing
RANGE_ERROR, BEARING_SIGMA = 0.01, np.radians(1)  # the examples of the text for (9)
MIN_BEARING_SIGMA = 0.01  # least σ_β of a foot point in the corrected R [rad]


class ThesisMAK(MAK):
    """MAK with point landmarks and Smolec's A (§4.1), [[1, 0, −Δy], [0, 1, Δx], [0, 0, 1]], for an
    angle in degrees; in radians, the displacement in this A is 180/π times as long."""

    def predict(self, x, Q):
        x = np.asarray(x, dtype=float)
        self._x[:2] -= (DEGREES - 1) * (x[:2] - self._x[:2])
        return super().predict(x, Q)


def make_filter(corrections, P):
    """Create a MAK with point landmarks, as printed or corrected; P : (3, 3) of the first pose."""
    if corrections >= {"radians", "H", "J"}:
        return MAK(np.zeros(3), P)
    made = MAK if "radians" in corrections else ThesisMAK
    return made(np.zeros(3), P, kind=_model(corrections))


def _model(corrections):
    """Return the landmark model with Smolec's H (2), J_xr (10), J_z (11), or corrected ones."""

    def H(x, p):
        H_r, H_p = (M.copy() for M in POINTS.H(x, p))
        if "H" not in corrections:
            H_r[..., 1, 1] *= -1
            H_p[..., 1, 1] *= -1  # (3) follows from (2)
        if "radians" not in corrections:
            H_r[..., 1, :2] /= DEGREES
            H_p[..., 1, :] /= DEGREES
        return H_r, H_p

    def J(x, z):
        J_xr, J_z = (M.copy() for M in POINTS.J(x, z))
        if "J" not in corrections:
            r = z[..., :1]
            J_xr[..., 2] = MM * np.array([-np.sin(x[2]), np.cos(x[2])])
            J_z[..., 1] *= MM / r
        if "radians" not in corrections:
            J_xr[..., 2] *= DEGREES
            J_z[..., 1] *= DEGREES
        return J_xr, J_z

    return replace(POINTS, H=H, J=J)


def predict(filter, odometry, robot, c, corrections):
    """Predict by odometry (3,) [m, m, rad]. Q is (8) with the factor c, or the corrected Q."""
    pose, odometry = filter.pose, np.asarray(odometry, dtype=float)
    if not odometry.any():
        return
    moved = compose(pose, odometry)
    if "Q" in corrections:
        Q = Q_arc(pose, odometry, robot)
    else:
        step = np.array([*(moved - pose)[:2], odometry[2]])
        Q = c * np.outer(step, step)
    filter.predict(moved, Q)


def R_foot_points(sensor, ranges, corrections):
    """Return R (m, 2, 2) [m², rad²] of foot points at ranges (m,), by Smolec's (9) or corrected."""
    if "R" in corrections:
        sigma = max(sensor.bearing_sigma, MIN_BEARING_SIGMA)
        return measurement_noise(replace(sensor, bearing_sigma=sigma), ranges)
    R = [noise.R(0.0, 0.0, BEARING_SIGMA, np.sqrt(RANGE_ERROR * MM * r)) for r in ranges]
    return np.reshape(R, (-1, 2, 2))
