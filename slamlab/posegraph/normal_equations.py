"""Sparse normal equations of a pose graph: H step = −g, each edge four 3 × 3 blocks of H.

H is the information (approximate Hessian) matrix, g the gradient.

Where the blocks fall depends on the edges alone. It is found once, and so is an order of the poses
that keeps the factors sparse; each round only fills numbers in.
"""

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import splu


class NormalEquations:
    """Sparse information matrix H and gradient g over the poses that are free.

    Parameters
    ----------
    pairs : (m, 2) int, poses i and j of each edge
    free : (n,) bool, which poses may move
    """

    def __init__(self, pairs, free):
        self.count = int(free.sum())
        place = np.full(len(free), -1)  # of a pose in H; −1 for one that does not move
        place[np.flatnonzero(free)[_fill_reducing_order(pairs, free)]] = np.arange(self.count)
        self._unknowns = np.where(place[:, None] < 0, -1, 3 * place[:, None] + np.arange(3))
        unknowns = self._unknowns[pairs].reshape(-1, 6)
        rows, columns = np.broadcast_arrays(unknowns[:, :, None], unknowns[:, None, :])
        self._used = (rows >= 0) & (columns >= 0)
        size = 3 * self.count
        cells = columns[self._used].astype(np.int64) * size + rows[self._used]
        cells, self._slot = np.unique(cells, return_inverse=True)
        column, self._row = np.divmod(cells, size)
        self._start = np.searchsorted(column, np.arange(size + 1))
        self._diagonal = np.flatnonzero(column == self._row)
        self._rows_used = unknowns >= 0
        self._g_slot = unknowns[self._rows_used]

    def linearise(self, J, information, e):
        """Linearise: assemble H = Σ JᵀΛJ and g = Σ JᵀΛe, half the cost's gradient (Gauss-Newton).

        Equation (15.5).

        Parameters
        ----------
        J : (m, 3, 6) Jacobian of each edge over pose i and pose j
        information : (m, 3, 3) information matrices Λ
        e : (m, 3) residuals

        Returns
        -------
        (3k, 3k) csc_array, (3k,), of the k free poses
        """
        JtL = J.transpose(0, 2, 1) @ information
        filled = np.bincount(self._slot, (JtL @ J)[self._used], len(self._row))
        H = sparse.csc_array((filled, self._row, self._start), shape=(3 * self.count,) * 2)
        g = (JtL @ e[..., None])[..., 0][self._rows_used]
        return H, np.bincount(self._g_slot, g, 3 * self.count)

    def damped(self, H, damping):
        """Damp H by raising its diagonal by a share (Levenberg-Marquardt).

        Parameters
        ----------
        H : csc_array of ``linearise``
        damping : float λ [1]

        Returns
        -------
        csc_array
        """
        filled = H.data.copy()
        filled[self._diagonal] *= 1 + damping
        return sparse.csc_array((filled, H.indices, H.indptr), shape=H.shape)

    def to_poses(self, step):
        """Increment of the unknowns as increments of all poses; those that are fixed get 0.

        Parameters
        ----------
        step : (3k, ...) in the order of H

        Returns
        -------
        (n, 3, ...)
        """
        return np.concatenate([step, np.zeros((1, *step.shape[1:]))])[self._unknowns]

    def to_columns(self, rows, poses):
        """Expand Jacobian rows over two poses (3, 6) to columns over all unknowns, to solve with.

        Parameters
        ----------
        rows : (c, 3, 6)
        poses : (c, 2) int

        Returns
        -------
        (3k, 3c)
        """
        unknowns = self._unknowns[poses].reshape(-1, 6)
        out = np.zeros((3 * self.count + 1, len(rows), 3))  # what is fixed falls into the last row
        np.add.at(out, (unknowns, np.arange(len(rows))[:, None]), rows.transpose(0, 2, 1))
        return out[:-1].reshape(3 * self.count, -1)


def factorise(H):
    """Factorise H (sparse LU, symmetric mode), which is positive definite and well ordered already.

    Parameters
    ----------
    H : csc_array

    Returns
    -------
    scipy.sparse.linalg.SuperLU

    Raises
    ------
    ValueError : H is singular to rounding
    """
    try:
        # relax=1: columns merged beyond their own pattern cost more than they save on such graphs
        options = {"diag_pivot_thresh": 0.0, "relax": 1, "options": {"SymmetricMode": True}}
        return splu(H, permc_spec="NATURAL", **options)
    except RuntimeError:
        raise ValueError(
            "the poses are under-constrained by these edges: some information is close to zero"
        ) from None


def _fill_reducing_order(pairs, free):
    """Fill-reducing order of the free poses by minimum degree; the 3 × 3 blocks have the same."""
    count = len(free)
    links = sparse.coo_array((np.ones(len(pairs)), tuple(pairs.T)), shape=(count, count)).tocsr()
    links = (links + links.T)[free][:, free]
    # any matrix with these entries will do, such as one whose diagonal outweighs them
    links = (links + sparse.diags_array(links.sum(axis=1) + 1)).tocsc()
    factors = splu(links, permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True})
    return np.argsort(factors.perm_c)
