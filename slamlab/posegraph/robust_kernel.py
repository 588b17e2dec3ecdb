"""Robust kernel: dynamic covariance scaling (DCS) against outlier edges (Agarwal et al. 2013).

With χ² = eᵀΛe the edge's information is scaled by s², s = min(1, 2Φ/(Φ + χ²)). That is a robust
kernel whose cost ρ(χ²) = ∫ s² dχ² never exceeds 3Φ: within Φ an edge counts as if it were trusted,
far beyond it, as an outlier, hardly pulls at all.
"""

import numpy as np

PHI = 11.345  # 99 % of true edges have a χ² of 3 degrees of freedom below this [1]


def weight(chi2, phi=PHI):
    """Weight s² of an edge by the robust kernel: 1 up to Φ, then falling like 1/χ⁴.

    Equation (15.10).

    Parameters
    ----------
    chi2 : (...) each edge's eᵀΛe [1]
    phi : float or (...), Φ [1]

    Returns
    -------
    (...) in (0, 1]
    """
    return (2 * phi / (phi + np.maximum(chi2, phi))) ** 2


def cost(chi2, phi=PHI):
    """Cost of the robust kernel: ρ(χ²) = χ² up to Φ, 3Φ − 4Φ²/(Φ + χ²) beyond.

    Equation (15.9).

    Parameters
    ----------
    chi2 : (...) each edge's eᵀΛe [1]
    phi : float or (...), Φ [1]

    Returns
    -------
    (...) [1]
    """
    return np.where(chi2 <= phi, chi2, 3 * phi - 4 * phi * (phi / (phi + chi2)))
