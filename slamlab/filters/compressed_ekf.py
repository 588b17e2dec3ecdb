"""Compressed EKF (CEKF): filters in a local region, and later updates the global map exactly.

Guivant & Nebot (2001). While only landmarks of a region A are observed, three small sums φ, ψ, θ
suffice to update the others (B): P_AB ← φ P_AB,  P_BB ← P_BB − P_BA ψ P_AB,  x_B ← x_B + P_BA θ.
"""

import numpy as np
from scipy.linalg.blas import dtrsm, dtrsv

from slamlab.filters.augmented_state import ROBOT_ROWS
from slamlab.filters.ekf_slam_filter import MAK


class CompressedEKF:
    """Compressed EKF-SLAM, which updates the global map only when the robot changes regions.

    mak : MAK, the global map; outside the region it is out of date until :meth:`settle`.
    """

    def __init__(self, mak: MAK):
        self.whole = mak
        self._local: MAK | None = None

    @property
    def local(self) -> MAK:
        """The filter of the active region, read-only. Raises ValueError if no region is active."""
        if self._local is None:
            raise ValueError("no region is active: call focus with the ids of its landmarks first")
        return self._local

    def focus(self, ids):
        """Settle the last region, then activate the region that consists of the given landmarks."""
        rows = self.whole.rows(ids)
        self.settle()
        self._rows = np.concatenate([ROBOT_ROWS, rows])
        self._local = self.whole.marginal(ids)
        n = len(self._rows)
        self._phi, self._psi, self._theta = np.eye(n), np.zeros((n, n)), np.zeros(n)

    def predict(self, x, Q):
        """Predict the local region, like :meth:`MAK.predict`: φ ← A φ."""
        A = self.local.predict(x, Q)
        self._phi[:3] = A @ self._phi[:3]

    def update(self, ids, z, R):
        """Update the local region by a measurement, like :meth:`MAK.update`.

        ψ ← ψ + φᵀ Hᵀ S⁻¹ H φ,  θ ← θ + φᵀ Hᵀ S⁻¹ v,  φ ← (I − K H) φ
        """
        step = self.local.update(ids, z, R)
        H_phi = step.H @ self._phi[step.columns]
        white = dtrsm(1.0, step.root, H_phi, lower=1)
        self._psi += white.T @ white
        self._theta += white.T @ dtrsv(step.root, step.innovation, lower=1)
        self._phi -= step.B @ white
        return step

    def settle(self):
        """Bring every landmark outside the region up to date (global update). Equation (07.14)."""
        if self._local is None:
            return
        whole, A = self.whole, self._rows
        rest = np.setdiff1d(np.arange(len(whole.x)), A)
        P_A = whole._P.columns(A)
        whole._x[rest] += P_A[rest] @ self._theta
        whole._x[A] = self._local.x
        values, vectors = np.linalg.eigh(self._psi)
        whole._P.downdate(np.asfortranarray(P_A @ (vectors * np.sqrt(np.maximum(values, 0)))))
        whole._P.set_rows(A, P_A @ self._phi.T, self._local.P)
        whole._predicted_position = self._local._predicted_position
        self._local = None
