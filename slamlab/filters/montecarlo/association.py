"""Which object was seen, where the belief is a cloud: gates as wide as its samples spread."""

from dataclasses import dataclass
from math import log

import numpy as np

from slamlab.filters.association import paired
from slamlab.geometry import wrap
from slamlab.models import h


@dataclass(frozen=True)
class Expected:
    """How objects would look, by samples of pose and place.

    Parameters
    ----------
    z : (N, 2) mean range [m] and bearing [rad]
    S : (N, 2, 2) its covariance, without the sensor's noise
    """

    z: np.ndarray
    S: np.ndarray


def expected(x, p, weights):
    """Mean and covariance of how objects look.

    Parameters
    ----------
    x : (n, 3) poses [m, m, rad]
    p : (n, N, 2) a place of every object for each of these poses [m]
    weights : (n,) that sum to one

    Returns
    -------
    Expected
    """
    z = h(x[:, None], p)
    first = z[0].copy()
    off = z - first
    off[..., 1] = wrap(off[..., 1])
    mean = np.einsum("i,ijk->jk", weights, off)
    off -= mean
    at = first + mean
    at[:, 1] = wrap(at[:, 1])
    return Expected(at, np.einsum("i,ijk,ijl->jkl", weights, off, off))


def pair(z, R, seen, probability=0.99, new=0.9999):
    """Pair sightings with objects, the nearest first, an object with one sighting at most.

    The square distance vᵀ (S + R)⁻¹ v is that of χ² with 2 degrees of freedom. What is inside the
    gate of an object is the object, what is outside of every object's far gate is new, and what
    lies between could be either.

    Parameters
    ----------
    z : (m, 2) range [m] and bearing [rad]
    R : (m, 2, 2)
    seen : Expected of N objects
    probability : float, of a true pairing to pass the gate
    new : float, of a true pairing to pass the far gate

    Returns
    -------
    {row of z: row of objects}
    list of rows of z that are new
    """
    m, N = len(z), len(seen.z)
    if not N:
        return {}, list(range(m))
    v = z[:, None] - seen.z
    v[..., 1] = wrap(v[..., 1])
    S = seen.S + R[:, None]
    d2 = np.einsum("ijk,ijk->ij", v, np.linalg.solve(S, v[..., None])[..., 0])
    return paired(d2, -2 * log(1 - probability), -2 * log(1 - new))
