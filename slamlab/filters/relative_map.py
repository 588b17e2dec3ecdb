"""The relative map: vectors between landmarks; uncertainty never grows (MAK thesis, 4.3.5).

Of two walls' lines it is the difference of their (ρ, α), the angle wrapped.
"""

import numpy as np


def relative_vector(mak, i, j):
    """Relative vector Δp_ij = p_j − p_i and its covariance P_ii − P_ij − P_ji + P_jj.

    Equation (07.10).

    Parameters
    ----------
    mak : MAK
    i, j : ids of two landmarks

    Returns
    -------
    (2,) [m] or of lines [m, rad], (2, 2) its covariance

    Raises
    ------
    ValueError : an id that is not in the map
    """
    rows = mak.rows([i, j])
    D = np.hstack([-np.eye(2), np.eye(2)])
    p_i, p_j = mak.x[rows].reshape(2, 2)
    return mak.kind.minus(p_j, p_i), D @ mak.block(rows) @ D.T


def relative_map(mak, pairs):
    """The relative map: relative vectors of many landmark pairs, with covariances.

    Parameters
    ----------
    mak : MAK
    pairs : (k, 2) ids

    Returns
    -------
    (k, 2) [m], (k, 2, 2) [m²]

    Raises
    ------
    ValueError : an id that is not in the map
    """
    found = [relative_vector(mak, i, j) for i, j in pairs]
    return (
        np.array([d for d, _ in found]).reshape(-1, 2),
        np.array([P for _, P in found]).reshape(-1, 2, 2),
    )
