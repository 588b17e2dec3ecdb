"""Argument checks (validation) of the filters: shapes, NaN, symmetric positive semidefinite."""

from itertools import chain
from math import isfinite

import numpy as np
from scipy.linalg.lapack import dpotrf

SYMMETRY_TOLERANCE = 1e-9  # relative; rounding stays far below, a mistake is far above


def vector(name, value, length=None):
    """Check a vector: finite floats, or an error that names the argument.

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


def matrix(name, value, rows, columns):
    """Check a matrix: finite floats, or an error that names the argument.

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


def covariance(name, value, size):
    """Check a covariance: symmetric and positive semidefinite (PSD), or an error that names it.

    No eigenvalue lies below −ε when P + ε I has a Cholesky factor, which is cheap to try.

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
    slack = SYMMETRY_TOLERANCE * max(map(abs, P.ravel().tolist()), default=0.0)
    symmetric = P.tobytes() == P.T.tobytes()  # nearly always, and cheap to ask
    if not symmetric and np.abs(P - P.T).max(initial=0.0) > slack:
        raise ValueError(f"{name} is not symmetric: a covariance equals its transpose")
    shifted = P.flatten()
    shifted[:: size + 1] += slack
    if slack and dpotrf(shifted.reshape(size, size))[1]:
        raise ValueError(
            f"{name} has a negative eigenvalue: no covariance has (variances, not deviations?)"
        )
    return P


def observations(z, R, m=None):
    """Check the observations of one scan and their measurement noise, or say what is wrong.

    Parameters
    ----------
    z : (m, 2) array-like, range [m], bearing [rad]
    R : (2, 2) measurement noise of each, or (m, 2, 2)
    m : int or None, for any

    Returns
    -------
    (m, 2), (2, 2) or (m, 2, 2) float arrays

    Raises
    ------
    ValueError
    """
    z, R = _numbers("z", z), _numbers("R", R)
    if m is None:
        m = z.shape[0] if z.ndim else 1
    if m == 0:
        raise ValueError("nothing was seen: leave empty scans out")
    if z.shape != (m, 2):
        raise ValueError(f"z has shape {z.shape}, expected ({m}, 2): a row for each id")
    if R.shape not in ((2, 2), (m, 2, 2)):
        raise ValueError(f"R has shape {R.shape}, expected (2, 2) or ({m}, 2, 2)")
    seen, noise = z.tolist(), R.reshape(-1, 4).tolist()  # a scan is short: floats are faster
    if not all(map(isfinite, chain(*seen, *noise))):
        raise ValueError("z or R holds NaN or infinity")
    if any(r <= 0 for r, _ in seen):
        raise ValueError("z: a range is not positive")
    if any(b != c or a < 0 or d < 0 or a * d < b * c for a, b, c, d in noise):
        raise ValueError("R is no covariance: it must be symmetric and positive semidefinite")
    return z, R


def _numbers(name, value):
    try:
        return np.asarray(value, dtype=float)
    except (TypeError, ValueError):
        raise ValueError(f"{name} is not an array of numbers") from None


def _finite(name, value, shape):
    array = _numbers(name, value)
    if array.shape != shape and not _fits(array.shape, shape):
        want = tuple("any" if n is None else n for n in shape)
        raise ValueError(f"{name} has shape {array.shape}, expected {want}")
    if not all(map(isfinite, array.ravel().tolist())):  # arguments are small: floats are faster
        raise ValueError(f"{name} holds NaN or infinity")
    return array


def _fits(got, want):
    return len(got) == len(want) and all(
        w is None or w == g for g, w in zip(got, want, strict=True)
    )
