"""Merging two landmarks that are one: an exact observation of their difference, which is zero.

Two entries of one thing are no error of a filter that keeps every correlation, but what either
learns the other does not. Held equal, both know it, and one of them is needed no more.
"""

import numpy as np

from slamlab.filters.relative_map import relative_vector


def squared_difference(mak, i, j):
    """Squared Mahalanobis distance of two landmarks from being one: dᵀ D⁻¹ d of d = p_j − p_i.

    D = P_ii − P_ij − P_ji + P_jj; if they are one, it is χ² of 2 degrees of freedom.
    Equation (09.4).

    Parameters
    ----------
    mak : MAK
    i, j : ids of two landmarks

    Returns
    -------
    float; infinite where the difference is held to be known without error
    """
    d, D = relative_vector(mak, i, j)
    try:
        return float(d @ np.linalg.solve(D, d))
    except np.linalg.LinAlgError:
        return np.inf


def merge(mak, kept, gone):
    """Merge two landmarks: the update by d = p_gone − p_kept = 0 with R = 0; one leaves the state.

    P ← P − P Hᵀ (H P Hᵀ)⁻¹ H P with H = ∂d/∂x, after which both are equal for sure. Of copies that
    are independent the information adds up: P⁻¹ = P_kept⁻¹ + P_gone⁻¹. Equation (09.3).

    Parameters
    ----------
    mak : MAK
    kept, gone : ids of the two

    Returns
    -------
    UpdateResult, of the state before ``gone`` left it

    Raises
    ------
    ValueError : an id that is not in the map, or a difference that is held to be known without
        error; nothing was changed
    """
    d, _ = relative_vector(mak, kept, gone)
    H = np.hstack([-np.eye(2), np.eye(2)])
    try:
        result = mak.correct(-d, H, mak.rows([kept, gone]), 0.0)
    except ValueError as error:
        raise ValueError(f"{kept}, {gone}: P holds their difference to be certain") from error
    mak.remove([gone])
    return result
