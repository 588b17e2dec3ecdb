"""Correlation matrix (correlation coefficients) of a covariance."""

import numpy as np


def correlation(P):
    """Compute the correlation coefficients ρ_ij = P_ij / √(P_ii P_jj); 0 if a variance is 0.

    P : (..., n, n) symmetric positive semidefinite. Returns (..., n, n), from −1 to 1. Raises
    ValueError.
    """
    P = np.asarray(P, dtype=float)
    if P.ndim < 2 or P.shape[-1] != P.shape[-2]:
        raise ValueError(f"a covariance must be square, but this one has shape {P.shape}")
    variances = np.diagonal(P, axis1=-2, axis2=-1)
    if not np.isfinite(P).all() or (variances < 0).any():
        raise ValueError("a covariance must not contain NaN, infinity or a negative variance")
    with np.errstate(divide="ignore"):
        scale = np.where(variances > 0, 1 / np.sqrt(variances), 0)
    # by rounding, a correlation of 1 may be larger
    return np.clip(P * scale[..., None, :] * scale[..., :, None], -1, 1)
