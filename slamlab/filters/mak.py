"""MAK, the map-augmented Kalman filter: EKF-SLAM with every correlation kept (MAK thesis, 4.3).

State [x_r p_1 … p_N], equation (06.1). Lesson 06 derives the textbook form; this one does the same
on one triangle of P in place: a scan of m landmarks costs one symmetric update of rank 2m.
"""

import numpy as np
from scipy.linalg.blas import dgemm, dtrsm, dtrsv
from scipy.linalg.lapack import dpotrf

from slamlab.filters.argument_checks import covariance, observations, vector
from slamlab.filters.augmented_state import ROBOT_ROWS, AugmentedState, unique_ids
from slamlab.filters.landmark_models import POINTS
from slamlab.filters.update_result import UpdateResult
from slamlab.geometry import wrap


class MAK(AugmentedState):
    """EKF-SLAM: robot pose and landmarks estimated jointly, correlations included.

    Parameters
    ----------
    x : (3,) pose at the start [m, m, rad]
    P : (3, 3) its covariance
    capacity : int, landmarks to allocate memory for; more may come
    first_estimates : bool, first-estimates Jacobians (FEJ): linearise at the first estimate
        (Huang, Mourikis, Roumeliotis 2010), which keeps the filter from gaining false certainty
    drop_cross_terms_for_demonstration : bool, throw the correlations away after each step;
        the filter is then wrong, which is what lesson 07 shows
    kind : LandmarkModel, of points or walls' lines; "z" and "R" below are what it observes

    Raises
    ------
    ValueError
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
        """EKF prediction by the motion: only the robot's rows and columns of P change.

        P_rr ← A P_rr Aᵀ + Q,  P_ri ← A P_ri, where A = [[1, 0, −Δy], [0, 1, Δx], [0, 0, 1]] for
        every motion that is driven in the robot's own frame, Δ being its displacement.
        Equation (06.3).

        Parameters
        ----------
        x : (3,) the new pose f(pose, u) [m, m, rad]
        Q : (3, 3) process noise: covariance of the motion

        Returns
        -------
        (3, 3) A, the motion Jacobian

        Raises
        ------
        ValueError
        """
        x, Q = vector("x", x, 3), covariance("Q", Q, 3)
        dx, dy = x[:2] - (self._predicted_position if self.first_estimates else self._x[:2])
        A = np.array([[1, 0, -dy], [0, 1, dx], [0, 0, 1.0]])
        L = self._P.lower
        L[0, 1], L[0, 2], L[1, 2] = L[1, 0], L[2, 0], L[2, 1]
        L[:3, :3] = A @ L[:3, :3] @ A.T + Q
        heading = L[3:, 2]
        L[3:, 0] -= dy * heading
        L[3:, 1] += dx * heading
        self._x[:2], self._x[2] = x[:2], wrap(x[2])
        self._predicted_position = x[:2].copy()
        return A

    def update(self, ids, z, R):
        """EKF measurement update by landmarks in the map, all observations of a scan at once.

        P ← P − K S Kᵀ with K = P Hᵀ S⁻¹ (the Kalman gain), as P − B Bᵀ with B = P (L⁻¹ H)ᵀ and
        S = L Lᵀ. Equation (06.9), with the H of (06.7).

        Parameters
        ----------
        ids : (m,) landmark ids, each once
        z : (m, 2) range [m], bearing [rad]
        R : (2, 2) measurement noise of each, or (m, 2, 2)

        Returns
        -------
        UpdateResult

        Raises
        ------
        ValueError : nothing was changed
        """
        rows = self.rows(ids)
        z, R = observations(z, R, len(rows) // 2)
        v, H, index = self._linearise(rows, z)
        return self.correct(v, H, index, R)

    def correct(self, v, H, columns, R):
        """Kalman update by any linear observation, an exact one included: v = H δx + noise of R.

        Parameters
        ----------
        v : (2m,) innovation
        H : (2m, k) its Jacobian over some columns of the state
        columns : (k,) int, which those are
        R : (m, 2, 2) noise of each two rows, or 0: exact

        Returns
        -------
        UpdateResult

        Raises
        ------
        ValueError : S = H P Hᵀ + R is singular; nothing was changed
        """
        seen = self._P.columns(columns)
        S = H @ seen[columns] @ H.T
        blocks = _diagonal_blocks(S)
        blocks += R
        root, failed = dpotrf(S, lower=1, clean=1)
        if failed:
            raise ValueError("R: S = H P Hᵀ + R is singular; give R a positive variance")
        B = dgemm(1.0, seen, dtrsm(1.0, root, H, lower=1), trans_b=1)
        self._x[: self._P.n] += B @ dtrsv(root, v, lower=1)
        self._x[2] = wrap(self._x[2])
        self._P.downdate(B)
        if self.drop_cross_terms:
            self._drop_cross_covariances()
        return UpdateResult(v, S, root, B, H, columns)

    def add(self, ids, z, R):
        """Landmark initialisation by state augmentation: new landmarks enter (Smolec (16), (17)).

        P_nn = J_xr P_rr J_xrᵀ + J_z R J_zᵀ,  P_n· = J_xr P_r·. Equations (06.4) to (06.6).

        Parameters
        ----------
        ids : (k,) new ids
        z : (k, 2) range [m], bearing [rad]
        R : (2, 2) measurement noise of each, or (k, 2, 2)

        Raises
        ------
        ValueError : an id that is in the map already; nothing was changed
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
        """Innovation (2m,), Jacobian H over the columns it touches (2m, 3 + 2m), those columns."""
        m = len(z)
        x, p = self._x[:3], self._x[rows].reshape(m, 2)
        v = z - self.kind.h(x, p)
        v[:, 1] = wrap(v[:, 1])
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
    """(m, 2, 2) view of the 2 × 2 blocks along the diagonal that starts in a column of M."""
    down, right = M.strides
    return np.ndarray(
        (len(M) // 2, 2, 2), float, M, column * right, (2 * (down + right), *M.strides)
    )
