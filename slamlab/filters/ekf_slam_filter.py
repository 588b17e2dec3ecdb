"""EKF-SLAM: the map-augmented Kalman filter (MAK), with all correlations (MAK thesis, 4.3).

The state is [x_r p_1 … p_N], equation (06.1). A scan of m landmarks gives one update of rank 2m.
"""

import numpy as np
from scipy.linalg.blas import dgemm, dtrsm, dtrsv
from scipy.linalg.lapack import dpotrf

from slamlab.filters.argument_checks import covariance, observations, vector
from slamlab.filters.augmented_state import ROBOT_ROWS, AugmentedState, unique_ids
from slamlab.filters.kalman_filter import UpdateResult
from slamlab.filters.landmark_models import POINTS, difference
from slamlab.geometry import wrap


class MAK(AugmentedState):
    """EKF-SLAM: joint estimate of the robot's pose and the landmarks, with their correlations.
    Raises ValueError.

    Parameters
    ----------
    x, P : (3,) initial pose [m, m, rad], (3, 3) its covariance
    capacity : int, landmarks to allocate memory for
    first_estimates : bool, first-estimates Jacobians (Huang, Mourikis, Roumeliotis 2010)
    drop_cross_terms_for_demonstration : bool, drop all cross-covariances, which is wrong
    kind : LandmarkModel
    """

    def __init__(
        self,
        x,
        P,
        capacity=100,
        *,
        first_estimates=False,
        drop_cross_terms_for_demonstration=False,
        kind=POINTS,
    ):
        super().__init__(x, P, capacity)
        self.first_estimates = first_estimates
        self.drop_cross_terms = drop_cross_terms_for_demonstration
        self.kind = kind
        self._predicted_position = self._x[:2].copy()

    def predict(self, x, Q):
        """EKF prediction: x = f(pose, u) (3,) is the new pose; returns A (3, 3). Equation (06.3).

        P_rr ← A P_rr Aᵀ + Q, P_ri ← A P_ri, A = [[1, 0, −Δy], [0, 1, Δx], [0, 0, 1]] with the
        displacement (Δx, Δy).
        """
        x, Q = vector("x", x, 3), covariance("Q", Q, 3)
        last = self._predicted_position if self.first_estimates else self._x[:2]
        dx, dy = (x[:2] - last).tolist()  # Python's floats are faster than numpy's
        A = np.array([[1, 0, -dy], [0, 1, dx], [0, 0, 1.0]])
        L = self._P.lower
        L[0, 1], L[0, 2], L[1, 2] = L[1, 0], L[2, 0], L[2, 1]
        L[:3, :3] = A @ L[:3, :3] @ A.T + Q
        heading = L[3:, 2]
        L[3:, 0] -= dy * heading
        L[3:, 1] += dx * heading
        self._x[:2], self._x[2] = x[:2], wrap(float(x[2]))
        self._predicted_position = x[:2].copy()
        return A

    def update(self, ids, z, R):
        """EKF measurement update: correct by all known landmarks of a scan. Equation (06.9).

        P ← P − K S Kᵀ, K = P Hᵀ S⁻¹, H of (06.7); z : (m, 2) [m, rad]; R : (2, 2) or (m, 2, 2). A
        ValueError leaves the state unchanged.
        """
        rows = self.rows(ids)
        z, R = observations(z, R, len(rows) // 2)
        v, H, index = self._linearise(rows, z)
        return self.correct(v, H, index, R)

    def correct(self, v, H, columns, R):
        """Correct by a linear measurement v = H δx + noise of covariance R, which may be 0.

        H : (2m, k) over ``columns`` of the state; R : (m, 2, 2). ValueError if the innovation
        covariance S is singular.
        """
        seen = self._P.columns(columns)
        S = H @ seen[columns] @ H.T
        blocks = _diagonal_blocks(S)
        blocks += R
        root, failed = dpotrf(S, lower=1, clean=1)
        if failed:
            raise ValueError("S = H P Hᵀ + R is singular: give R a positive variance")
        # P − K S Kᵀ = P − B Bᵀ with S = L Lᵀ, B = P (L⁻¹ H)ᵀ
        B = dgemm(1.0, seen, dtrsm(1.0, root, H, lower=1), trans_b=1)
        self._x[: self._P.n] += B @ dtrsv(root, v, lower=1)
        self._x[2] = wrap(float(self._x[2]))
        self._P.downdate(B)
        if self.drop_cross_terms:
            self._drop_cross_covariances()
        return UpdateResult(v, S, root, B, H, columns)

    def add(self, ids, z, R):
        """Landmark initialisation (state augmentation): add landmarks by g, the
        inverse measurement model (inverse observation model). Smolec (16), (17), Equations (06.4)
        to (06.6).

        P_nn = J_xr P_rr J_xrᵀ + J_z R J_zᵀ, P_n· = J_xr P_r·. A ValueError leaves the state
        unchanged.
        """
        ids = unique_ids(ids)
        known = [i for i in ids if i in self._row]
        if known:
            raise ValueError(f"ids: {known} are in the map already; update them instead")
        z, R = observations(z, R, len(ids))
        J_xr, J_z = self.kind.J(self._x[:3], z)
        J_xr = J_xr.reshape(-1, 3)
        cross = J_xr @ self._P.columns(ROBOT_ROWS).T
        corner = cross[:, :3] @ J_xr.T
        _diagonal_blocks(corner)[...] += J_z @ R @ J_z.transpose(0, 2, 1)
        self._augment(ids, self.kind.g(self._x[:3], z), cross, corner)
        if self.drop_cross_terms:
            self._drop_cross_covariances()

    def _linearise(self, rows, z):
        """Linearise h (for a first-estimates Jacobian, at first estimates); return innovation
        (2m,), Jacobian H (2m, 3 + 2m) over some columns of the state, and these columns."""
        m = len(z)
        x, p = self._x[:3], self._x[rows].reshape(m, 2)
        v = difference(z, self.kind.h(x, p))
        H_r, H_p = self.kind.H(x, self._first_estimates_of(rows) if self.first_estimates else p)
        H = np.zeros((2 * m, 3 + 2 * m))
        H[:, :3] = H_r.reshape(-1, 3)
        _diagonal_blocks(H, 3)[...] = H_p
        return v.ravel(), H, np.concatenate([ROBOT_ROWS, rows])

    def _drop_cross_covariances(self):
        L = self._P.lower
        L[3:, :3] = 0
        own = np.repeat(np.arange((self._P.n - 3) // 2), 2)
        L[3:, 3:][own[:, None] != own] = 0


def _diagonal_blocks(M, column=0):
    """Return a view of the 2 × 2 blocks (m, 2, 2) on the diagonal from a column of M."""
    down, right = M.strides
    return np.ndarray(
        (len(M) // 2, 2, 2), float, M, column * right, (2 * (down + right), *M.strides)
    )
