"""The compressed EKF (CEKF): filter in a local region, update the global map later, exactly.

Guivant & Nebot (2001), named by the MAK thesis in chapter 5. While only landmarks of a region A are
observed, the others (B) depend on three small sums φ, ψ, θ; the global update is:

    P_AB ← φ P_AB,   P_BB ← P_BB − P_BA ψ P_AB,   x_B ← x_B + P_BA θ
"""

import numpy as np
from scipy.linalg.blas import dtrsm, dtrsv

from slamlab.filters.augmented_state import ROBOT_ROWS
from slamlab.filters.mak import MAK


class CompressedMAK:
    """Compressed EKF-SLAM: pays for the global map only when the robot changes region.

    Parameters
    ----------
    mak : MAK, the whole; out of date for landmarks outside the region until :meth:`settle`
    """

    def __init__(self, mak: MAK):
        self.whole = mak
        self._local: MAK | None = None

    @property
    def local(self) -> MAK:
        """The local filter of the active region; read it, but predict and update this class.

        Raises
        ------
        ValueError : no region was chosen
        """
        if self._local is None:
            raise ValueError("no region: call focus with the ids of the landmarks around first")
        return self._local

    def focus(self, ids):
        """Choose the active region (local map), after the global update of the one before.

        Parameters
        ----------
        ids : landmarks that will be observed next

        Raises
        ------
        ValueError : an id that is not in the map
        """
        rows = self.whole.rows(ids)
        self.settle()
        self._rows = np.concatenate([ROBOT_ROWS, rows])
        self._local = self.whole.marginal(ids)
        n = len(self._rows)
        self._phi, self._psi, self._theta = np.eye(n), np.zeros((n, n)), np.zeros(n)

    def predict(self, x, Q):
        """EKF prediction in the local region as by :meth:`MAK.predict`: φ ← A φ."""
        A = self.local.predict(x, Q)
        self._phi[:3] = A @ self._phi[:3]

    def update(self, ids, z, R):
        """EKF measurement update in the local region, as by :meth:`MAK.update`.

        ψ ← ψ + φᵀ Hᵀ S⁻¹ H φ,  θ ← θ + φᵀ Hᵀ S⁻¹ v,  φ ← (I − K H) φ

        Returns
        -------
        UpdateResult, of the region's state
        """
        step = self.local.update(ids, z, R)
        H_phi = step.H @ self._phi[step.columns]
        white = dtrsm(1.0, step.root, H_phi, lower=1)
        self._psi += white.T @ white
        self._theta += white.T @ dtrsv(step.root, step.innovation, lower=1)
        self._phi -= step.B @ white
        return step

    def settle(self):
        """Global update: bring every landmark outside the region up to date. Equation (07.14)."""
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
