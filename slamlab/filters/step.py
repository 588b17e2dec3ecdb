"""What an update was made of, and the guards every filter puts before its arguments."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.linalg import solve_triangular

SYMMETRY = 1e-9  # relative; what rounding leaves is far below, a mistake far above


@dataclass(frozen=True)
class Step:
    """One update: innovation v, its covariance S, the gain K and the NIS.

    Parameters
    ----------
    innovation : (m,) v = z − h(x), bearings wrapped
    S : (m, m) H P Hᵀ + R
    root : (m, m) lower Cholesky root L of S = L Lᵀ
    B : (n, m) P Hᵀ L⁻ᵀ, so that P − B Bᵀ is the updated covariance
    H : (m, k) the Jacobian, over the columns that it touches
    columns : (k,) int, which those are
    """

    innovation: np.ndarray
    S: np.ndarray
    root: np.ndarray
    B: np.ndarray
    H: np.ndarray
    columns: np.ndarray

    @cached_property
    def K(self):
        """(n, m) the gain P Hᵀ S⁻¹."""
        return solve_triangular(self.root, self.B.T, lower=True, trans=1).T

    @cached_property
    def nis(self):
        """Normalised innovation squared vᵀ S⁻¹ v: χ² with m degrees of freedom when consistent."""
        white = solve_triangular(self.root, self.innovation, lower=True)
        return float(white @ white)


def vector(name, value, length=None):
    """A finite float vector, or an error that names the argument.

    Parameters
    ----------
    name : str
    value : array-like
    length : int or None, for any

    Returns
    -------
    (length,) float array

    Raises
    ------
    ValueError
    """
    return _finite(name, value, (length,))


def covariance(name, value, size):
    """A symmetric positive semidefinite matrix, or an error that names the argument.

    Parameters
    ----------
    name : str
    value : (size, size) array-like

    Returns
    -------
    (size, size) float array

    Raises
    ------
    ValueError
    """
    P = _finite(name, value, (size, size))
    scale = np.abs(P).max(initial=0.0)
    if np.abs(P - P.T).max(initial=0.0) > SYMMETRY * scale:
        raise ValueError(f"{name} is not symmetric: a covariance equals its transpose")
    if size and np.linalg.eigvalsh(P)[0] < -SYMMETRY * scale:
        raise ValueError(
            f"{name} has a negative eigenvalue: no covariance has (variances, not deviations?)"
        )
    return P


def matrix(name, value, rows, columns):
    """A finite float matrix, or an error that names the argument.

    Parameters
    ----------
    name : str
    value : (rows, columns) array-like; None for any number of rows or columns

    Returns
    -------
    (rows, columns) float array

    Raises
    ------
    ValueError
    """
    return _finite(name, value, (rows, columns))


def _finite(name, value, shape):
    try:
        array = np.asarray(value, dtype=float)
    except (TypeError, ValueError):
        raise ValueError(f"{name} is not an array of numbers") from None
    fits = array.ndim == len(shape) and all(
        want in (None, got) for want, got in zip(shape, array.shape, strict=True)
    )
    if not fits:
        want = tuple("any" if n is None else n for n in shape)
        raise ValueError(f"{name} has shape {array.shape}, expected {want}")
    if not np.isfinite(array).all():
        raise ValueError(f"{name} holds NaN or infinity")
    return array
