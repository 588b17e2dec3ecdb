"""Packed covariance: the lower triangle of a growing symmetric matrix, updated in place.

It lies in a column-major prefix of a flat buffer, allocated ahead. A prefix is contiguous, so BLAS
works on it without a copy; a block of a larger matrix it would silently copy.
"""

import numpy as np
from scipy.linalg.blas import dsyrk

UNIT_ROUNDOFF = float(np.finfo(float).eps) / 2  # u, relative error of a rounded number


class TriangularCovariance:
    """Symmetric positive semidefinite matrix of which only the lower triangle is stored.

    Parameters
    ----------
    P : (n, n) symmetric
    capacity : int, rows to allocate memory for
    """

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
        """(n, n) the full symmetric matrix, a copy with both triangles."""
        L = np.tril(self.lower)
        return L + np.tril(L, -1).T

    def columns(self, index):
        """Full columns of the matrix, gathered from both sides of the diagonal.

        Parameters
        ----------
        index : (k,) int array, row numbers

        Returns
        -------
        (n, k) column-major
        """
        L = self.lower
        out = L.T.take(index, axis=0).T
        for k, j in enumerate(index.tolist()):
            out[:j, k] = L[j, :j]
        return out

    def block(self, rows):
        """Submatrix of some rows and the same columns.

        Parameters
        ----------
        rows : (k,) int array

        Returns
        -------
        (k, k)
        """
        i, j = np.maximum(rows[:, None], rows), np.minimum(rows[:, None], rows)
        return self.lower[i, j]

    def downdate(self, B):
        """Low-rank downdate P ← P − B Bᵀ in place, kept positive semidefinite against rounding.

        Each entry of the result is off by at most γ √(P_ii P_jj) with γ = (m + 2) u, so adding
        n γ P_ii to the diagonal outweighs whatever rounding did (Higham 2002, §3.5).

        Parameters
        ----------
        B : (n, m) column-major
        """
        n, m = B.shape
        guard = self.diagonal * (n * (m + 2) * UNIT_ROUNDOFF)
        dsyrk(-1.0, B, beta=1.0, c=self.lower, lower=1, overwrite_c=1)
        self.diagonal += guard

    def set_rows(self, index, columns, corner):
        """Overwrite some rows and columns of the symmetric matrix.

        Parameters
        ----------
        index : (k,) row numbers
        columns : (n, k) their columns; entries that fall among themselves are not used
        corner : (k, k) the entries among themselves
        """
        L = self.lower
        for k, j in enumerate(index):
            L[j, :j] = columns[:j, k]
            L[j:, j] = columns[j:, k]
        L[np.ix_(index, index)] = corner

    def append(self, cross, corner):
        """Augment the matrix by k rows and columns.

        Parameters
        ----------
        cross : (k, n) the new rows left of the corner
        corner : (k, k)
        """
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
        """Delete (marginalise out) rows and columns.

        Parameters
        ----------
        rows : sequence of row numbers
        """
        keep = np.setdiff1d(np.arange(self.n), rows)
        kept = self.lower[np.ix_(keep, keep)]
        self._resize(len(keep))
        self.lower[:] = kept
