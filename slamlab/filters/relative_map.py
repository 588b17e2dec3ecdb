"""Relative map: vectors between landmarks, whose covariance never grows (MAK thesis, 4.3.5)."""

import numpy as np


def relative_vector(mak, i, j):
    """Return p_j − p_i, a relative vector, and P_ii − P_ij − P_ji + P_jj. Equation (07.10)."""
    rows = mak.rows([i, j])
    D = np.hstack([-np.eye(2), np.eye(2)])
    p_i, p_j = mak.x[rows].reshape(2, 2)
    return mak.kind.minus(p_j, p_i), D @ mak.block(rows) @ D.T
