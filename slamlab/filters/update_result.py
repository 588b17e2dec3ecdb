"""The result of a Kalman update: innovation v, its covariance S, gain K, NIS."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.linalg.blas import dtrsm, dtrsv


@dataclass(frozen=True)
class UpdateResult:
    """What a measurement update was made of: innovation v (residual), S, Kalman gain K, NIS.

    Parameters
    ----------
    innovation : (m,) v = z − h(x), bearings wrapped
    S : (m, m) innovation covariance H P Hᵀ + R
    root : (m, m) lower Cholesky factor L of S = L Lᵀ
    B : (n, m) P Hᵀ L⁻ᵀ, so that P − B Bᵀ is the updated covariance
    H : (m, k) the Jacobian, over the columns that it touches
    columns : (k,) int, which columns of the state those are
    """

    innovation: np.ndarray
    S: np.ndarray
    root: np.ndarray
    B: np.ndarray
    H: np.ndarray
    columns: np.ndarray

    @cached_property
    def K(self):
        """(n, m) the Kalman gain P Hᵀ S⁻¹."""
        return dtrsm(1.0, self.root, self.B, side=1, lower=1)

    @cached_property
    def nis(self):
        """NIS, normalised innovation squared vᵀ S⁻¹ v; consistent: χ², m degrees of freedom."""
        white = dtrsv(self.root, self.innovation, lower=1)
        return float(white @ white)
