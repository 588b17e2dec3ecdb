"""Landmark merging by a noise-free measurement: the difference of two landmarks is zero."""

import numpy as np

from slamlab.filters.relative_map import relative_vector


def squared_difference(mak, i, j):
    """Return dᵀ D⁻¹ d, the squared Mahalanobis distance of d = p_j − p_i from 0. Equation (09.4).

    D = P_ii − P_ij − P_ji + P_jj. For duplicates, dᵀ D⁻¹ d is χ² (2 degrees of freedom).
    """
    d, D = relative_vector(mak, i, j)
    try:
        return float(d @ np.linalg.solve(D, d))
    except np.linalg.LinAlgError:
        return np.inf


def merge(mak, kept, gone):
    """Merge two landmarks by measuring d = p_gone − p_kept = 0, R = 0; remove one. Equation (09.3).

    P ← P − P Hᵀ (H P Hᵀ)⁻¹ H P, H = ∂d/∂x. If P_ij = 0, the result has P⁻¹ = P_kept⁻¹ + P_gone⁻¹.
    If a ValueError is raised, the map is unchanged.
    """
    d, _ = relative_vector(mak, kept, gone)
    H = np.hstack([-np.eye(2), np.eye(2)])
    try:
        result = mak.correct(-d, H, mak.rows([kept, gone]), 0.0)
    except ValueError as error:
        raise ValueError(f"{kept}, {gone}: their difference has zero variance in P") from error
    mak.remove([gone])
    return result
