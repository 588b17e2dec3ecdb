"""Ideal EKF-SLAM, a reference for consistency: every Jacobian is evaluated at the ground truth.

The ideal filter is consistent if the noise is small.
"""

import numpy as np

from slamlab.geometry import wrap
from slamlab.models import jacobians, observation


class IdealEkfSlam:
    """Textbook EKF-SLAM with known true landmarks (n, 2) [m], whose ids are their row indices, and
    true poses."""

    def __init__(self, landmarks):
        self.true_landmarks = landmarks
        self.true_pose = np.zeros(3)
        self.x, self.P, self.ids = np.zeros(3), np.zeros((3, 3)), []

    def predict(self, x, Q, true_pose):
        """Predict the new pose x = f(pose, u) with noise Q (3, 3) and the Jacobian A of the true
        motion."""
        A = np.eye(3)
        A[:2, 2] = self.true_pose[1] - true_pose[1], true_pose[0] - self.true_pose[0]
        self.P[:3] = A @ self.P[:3]
        self.P[:, :3] = self.P[:, :3] @ A.T
        self.P[:3, :3] += Q
        self.x[:3], self.true_pose = x, true_pose

    def observe(self, ids, z, R):
        """Update with the known landmarks among ids (m,), z (m, 2), R (m, 2, 2), then add the new
        landmarks."""
        new = ~np.isin(ids, self.ids)
        if not new.all():
            self._update(ids[~new], z[~new], R[~new])
        for i, observed, covariance in zip(ids[new], z[new], R[new], strict=True):
            self._add(i, observed, covariance)

    def landmarks(self):
        """Return the landmark estimates (N, 2) in the order of ``ids`` [m]."""
        return self.x[3:].reshape(-1, 2)

    def _update(self, ids, z, R):
        m, n = len(ids), len(self.x)
        H, R_all, v = np.zeros((m, 2, n)), np.zeros((2 * m, 2 * m)), np.empty((m, 2))
        for k, i in enumerate(ids):
            j = 3 + 2 * self.ids.index(i)
            p = self.true_landmarks[i]
            H[k, :, :3] = jacobians.H_robot(self.true_pose, p)
            H[k, :, j : j + 2] = jacobians.H_landmark(self.true_pose, p)
            R_all[2 * k : 2 * k + 2, 2 * k : 2 * k + 2] = R[k]
            v[k] = z[k] - observation.h(self.x[:3], self.x[j : j + 2])
        v[:, 1] = wrap(v[:, 1])
        H = H.reshape(2 * m, n)
        S = H @ self.P @ H.T + R_all
        K = np.linalg.solve(S, H @ self.P).T
        self.x += K @ v.ravel()
        self.x[2] = wrap(self.x[2])
        I_KH = np.eye(n) - K @ H
        self.P = I_KH @ self.P @ I_KH.T + K @ R_all @ K.T

    def _add(self, i, z, R):
        true = observation.h(self.true_pose, self.true_landmarks[i])
        J_xr, J_z = jacobians.J_xr(self.true_pose, true), jacobians.J_z(self.true_pose, true)
        cross = J_xr @ self.P[:3]
        corner = cross[:, :3] @ J_xr.T + J_z @ R @ J_z.T
        self.x = np.concatenate([self.x, observation.g(self.x[:3], z)])
        self.P = np.block([[self.P, cross.T], [cross, corner]])
        self.ids.append(int(i))
