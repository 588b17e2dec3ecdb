"""Sparse normal equations of a pose graph: H δ = −g, where each edge adds four 3 × 3 blocks to H.

The sparsity pattern of H and a fill-reducing order of the poses are computed once.
"""

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import splu


class NormalEquations:
    """Information matrix H and gradient g over free poses or coordinates, mask (n,) or (n, 3).

    pairs (m, 2) are the edges; −1 is the world frame, which is fixed.
    """

    def __init__(self, pairs, free):
        free = np.vstack(
            [np.broadcast_to(free.reshape(len(free), -1), (len(free), 3)), [False] * 3]
        )
        pairs, moves = pairs % len(free), free.any(axis=1)  # the world frame comes last
        order = np.flatnonzero(moves)[_fill_reducing_order(pairs, moves)]
        self.count = int(free.sum())
        index = np.full((len(order), 3), -1)  # in H; −1 for fixed coordinates
        index[free[order]] = np.arange(self.count)
        self._unknowns = np.full(free.shape, -1)
        self._unknowns[order] = index
        unknowns = self._unknowns[pairs].reshape(-1, 6)
        rows, columns = np.broadcast_arrays(unknowns[:, :, None], unknowns[:, None, :])
        self._used = (rows >= 0) & (columns >= 0)
        size = self.count
        cells = columns[self._used].astype(np.int64) * size + rows[self._used]
        cells, self._slot = np.unique(cells, return_inverse=True)
        column, self._row = np.divmod(cells, size)
        self._start = np.searchsorted(column, np.arange(size + 1))
        self._diagonal = np.flatnonzero(column == self._row)
        self._rows_used = unknowns >= 0
        self._g_slot = unknowns[self._rows_used]

    def linearise(self, J, information, e):
        """Build the normal equations: H = Σ JᵀΛJ (information matrix) and g = Σ JᵀΛe, half the
        gradient of the cost (Gauss-Newton). Equation (15.5).

        J : (m, 3, 6) over poses i and j. Returns H (k, k), a csc_array, and g (k,) of k unknowns.
        """
        JtL = J.transpose(0, 2, 1) @ information
        filled = np.bincount(self._slot, (JtL @ J)[self._used], len(self._row))
        H = sparse.csc_array((filled, self._row, self._start), shape=(self.count,) * 2)
        g = (JtL @ e[..., None])[..., 0][self._rows_used]
        return H, np.bincount(self._g_slot, g, self.count)

    def damped(self, H, damping):
        """Return H with its diagonal multiplied by 1 + λ (Levenberg-Marquardt damping)."""
        filled = H.data.copy()
        filled[self._diagonal] *= 1 + damping
        return sparse.csc_array((filled, H.indices, H.indptr), shape=H.shape)

    def to_poses(self, step):
        """Expand an increment (k, ...) of unknowns to poses (n, 3, ...), with 0 for fixed poses."""
        return np.concatenate([step, np.zeros((1, *step.shape[1:]))])[self._unknowns[:-1]]

    def to_columns(self, rows, poses):
        """Expand Jacobian rows (c, 3, 6) over pose pairs (c, 2) to columns (k, 3c)."""
        unknowns = self._unknowns[poses].reshape(-1, 6)
        out = np.zeros((self.count + 1, len(rows), 3))  # the last row collects fixed coordinates
        np.add.at(out, (unknowns, np.arange(len(rows))[:, None]), rows.transpose(0, 2, 1))
        return out[:-1].reshape(self.count, -1)


def factorise(H, order="NATURAL"):
    """Factorise H (sparse factorisation: LU in symmetric mode, in place of sparse Cholesky), its
    columns in this order of ``splu``. Raises ValueError if H is singular."""
    try:
        # relax=1, panel_size=1: the factors of such graphs are so sparse that columns go one by one
        options = {"diag_pivot_thresh": 0.0, "relax": 1, "panel_size": 1}
        return splu(H, order, options={"SymmetricMode": True}, **options)
    except RuntimeError:
        raise ValueError(
            "the poses are under-constrained by these edges: an information matrix is nearly "
            "singular"
        ) from None


def _fill_reducing_order(pairs, free):
    """Return a fill-reducing order of the free poses by minimum degree, for their 3 × 3 blocks."""
    number, alone = np.cumsum(free) - 1, np.arange(np.count_nonzero(free))
    i, j = number[pairs[free[pairs].all(axis=1)]].T
    # any matrix of this pattern is suitable, such as a diagonally dominant one
    cells = np.concatenate([i, j, i, j, alone]), np.concatenate([j, i, i, j, alone])
    links = sparse.csc_array((np.ones(len(cells[0])), cells), shape=(len(alone),) * 2)
    return np.argsort(factorise(links, "MMD_AT_PLUS_A").perm_c)
