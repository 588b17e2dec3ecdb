"""Correlation matrix: a covariance free of units."""

import numpy as np


def correlation(P):
    """Correlation matrix: each correlation coefficient ρ_ij = P_ij / √(P_ii P_jj) of a covariance.

    What is certain (variance 0) shares nothing: its row and column are 0, the diagonal too.

    Parameters
    ----------
    P : (..., n, n) symmetric positive semidefinite

    Returns
    -------
    (..., n, n), from −1 to 1

    Raises
    ------
    ValueError : no square matrix, NaN, or a negative variance
    """
    P = np.asarray(P, dtype=float)
    if P.ndim < 2 or P.shape[-1] != P.shape[-2]:
        raise ValueError(f"a covariance is square, this has shape {P.shape}")
    variances = np.diagonal(P, axis1=-2, axis2=-1)
    if not np.isfinite(P).all() or (variances < 0).any():
        raise ValueError("no covariance holds NaN, infinity or a negative variance")
    with np.errstate(divide="ignore"):
        scale = np.where(variances > 0, 1 / np.sqrt(variances), 0)
    # rounding must not make a correlation of 1 larger than that
    return np.clip(P * scale[..., None, :] * scale[..., :, None], -1, 1)
