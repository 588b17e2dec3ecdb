"""Packed covariance: the lower triangle of a growing symmetric matrix, updated in place.

The triangle is column-major in a contiguous part of a flat buffer, so that BLAS makes no copies.
"""

import numpy as np
from scipy.linalg.blas import dsyrk

UNIT_ROUNDOFF = float(np.finfo(float).eps) / 2  # u, relative error of a rounded number


class TriangularCovariance:
    """Symmetric positive semidefinite matrix that stores only its lower triangle."""

    def __init__(self, P, capacity=0):
        n = len(P)
        self._flat = np.empty(max(n, capacity) ** 2)
        self._resize(n)
        self.lower[:] = P

    def _resize(self, n):
        self.n = n
        self.lower = self._flat[: n * n].reshape((n, n), order="F")
        self.diagonal = self._flat[: n * n : n + 1]

    def full(self):
        """Return the full symmetric matrix (n, n), a copy with both triangles."""
        L = np.tril(self.lower)
        return L + np.tril(L, -1).T

    def columns(self, index):
        """Return full columns (n, k), gathered from both sides of the diagonal, column-major."""
        L = self.lower
        out = L.T.take(index, axis=0).T
        for k, j in enumerate(index.tolist()):
            out[:j, k] = L[j, :j]
        return out

    def block(self, rows):
        """Return the submatrix (k, k) of the given rows and the same columns."""
        i, j = np.maximum(rows[:, None], rows), np.minimum(rows[:, None], rows)
        return self.lower[i, j]

    def downdate(self, B):
        """Downdate P ← P − B Bᵀ in place, semidefinite despite rounding; B column-major."""
        n, m = B.shape
        # the error of an entry is at most γ √(P_ii P_jj), γ = (m + 2) u; n γ P_ii compensates it
        # (Higham 2002, §3.5)
        guard = self.diagonal * (n * (m + 2) * UNIT_ROUNDOFF)
        dsyrk(-1.0, B, beta=1.0, c=self.lower, lower=1, overwrite_c=1)
        self.diagonal += guard

    def set_rows(self, index, columns, corner):
        """Overwrite rows (k,) with columns (n, k), their diagonal block with a corner (k, k)."""
        L = self.lower
        for k, j in enumerate(index):
            L[j, :j] = columns[:j, k]
            L[j:, j] = columns[j:, k]
        L[np.ix_(index, index)] = corner

    def append(self, cross, corner):
        """Augment the matrix by k rows: cross (k, n), to the left of the corner (k, k)."""
        n, k = self.n, len(corner)
        old = self.lower
        if (n + k) ** 2 > len(self._flat):
            self._flat = np.empty((2 * (n + k)) ** 2)
        else:
            old = old.copy(order="F")  # source and target overlap
        self._resize(n + k)
        self.lower[:n, :n] = old
        self.lower[n:, :n] = cross
        self.lower[n:, n:] = corner

    def delete(self, rows):
        """Delete rows and columns (marginalisation)."""
        keep = np.setdiff1d(np.arange(self.n), rows)
        kept = self.lower[np.ix_(keep, keep)]
        self._resize(len(keep))
        self.lower[:] = kept
