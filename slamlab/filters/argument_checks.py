"""Checks of the filters' arguments (input validation). Each ValueError names its argument."""

from itertools import chain
from math import isfinite

import numpy as np
from scipy.linalg.lapack import dpotrf

SYMMETRY_TOLERANCE = 1e-9  # relative; rounding errors are far smaller, mistakes far larger


def vector(name, value, length=None):
    """Check a vector of finite floats; None allows any length."""
    return _finite(name, value, (length,))


def matrix(name, value, rows, columns):
    """Check a matrix of finite floats; None allows any number of rows or columns."""
    return _finite(name, value, (rows, columns))


def covariance(name, value, size):
    """Check a covariance (size, size): symmetric and positive semidefinite."""
    P = _finite(name, value, (size, size))
    slack = SYMMETRY_TOLERANCE * max(map(abs, P.ravel().tolist()), default=0.0)
    if P.tobytes() != P.T.tobytes() and np.abs(P - P.T).max(initial=0.0) > slack:
        raise ValueError(f"{name} is not symmetric: a covariance must equal its transpose")
    if slack and dpotrf(P)[1] and dpotrf(P + slack * np.eye(size))[1]:
        raise ValueError(
            f"{name} has a negative eigenvalue, so it is not a covariance: its diagonal must be "
            "variances, not standard deviations"
        )
    return P


def observations(z, R, m=None):
    """Check the observations z (m, 2) of one scan, and their noise R, (2, 2) or (m, 2, 2)."""
    z, R = _numbers("z", z), _numbers("R", R)
    if m is None:
        m = z.shape[0] if z.ndim else 1
    if m == 0:
        raise ValueError("z contains no observations: leave out empty scans")
    if z.shape != (m, 2):
        raise ValueError(f"z has shape {z.shape}, expected ({m}, 2): one row for each id")
    if R.shape not in ((2, 2), (m, 2, 2)):
        raise ValueError(f"R has shape {R.shape}, expected (2, 2) or ({m}, 2, 2)")
    seen, noise = z.tolist(), R.reshape(-1, 4).tolist()  # a scan is short: floats are faster
    if not all(map(isfinite, chain(*seen, *noise))):
        raise ValueError("z or R contains NaN or infinity")
    if any(r <= 0 for r, _ in seen):
        raise ValueError("z contains a range that is not positive")
    if any(b != c or a < 0 or d < 0 or a * d < b * c for a, b, c, d in noise):
        raise ValueError("R must be a covariance: symmetric and positive semidefinite")
    return z, R


def nonsingular_observations(z, R, m=None):
    """Check observations z (m, 2) and their R (m, 2, 2), which must be positive definite."""
    z, R = observations(z, R, m)
    R = np.broadcast_to(R, (len(z), 2, 2))
    if not (R[:, 0, 0] * R[:, 1, 1] > R[:, 0, 1] ** 2).all():
        raise ValueError("R is singular, so z has no likelihood: make each variance positive")
    return z, R


def identified_observations(ids, z, R, known, new):
    """Check that all observations have different landmark ids, either all new or all known."""
    ids = list(ids)
    z, R = nonsingular_observations(z, R, len(ids))
    if len(set(ids)) < len(ids):
        raise ValueError("a landmark is observed twice in one scan: leave out one observation")
    if new and (there := set(ids) & set(known)):
        raise ValueError(f"{sorted(there)} are in the map already: update them")
    if not new and (missing := set(ids) - set(known)):
        raise ValueError(f"{sorted(missing)} are not in the map: add them first")
    return ids, z, R


def _numbers(name, value):
    try:
        return np.asarray(value, dtype=float)
    except (TypeError, ValueError):
        raise ValueError(f"{name} is not an array of numbers") from None


def _finite(name, value, shape):
    array = _numbers(name, value)
    if array.shape != shape and (
        array.ndim != len(shape)
        or any(want not in (None, got) for want, got in zip(shape, array.shape, strict=True))
    ):
        want = tuple("any" if n is None else n for n in shape)
        raise ValueError(f"{name} has shape {array.shape}, expected {want}")
    if not all(map(isfinite, array.ravel().tolist())):  # arguments are small: floats are faster
        raise ValueError(f"{name} contains NaN or infinity")
    return array
