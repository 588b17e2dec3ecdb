"""Data association for particle filters: gating by the spread of the particles."""

from dataclasses import dataclass
from math import log

import numpy as np

from slamlab.filters.data_association import gated_nearest_neighbours
from slamlab.geometry import wrap
from slamlab.models.observation import h


@dataclass(frozen=True)
class ExpectedScan:
    """Expected observations of landmarks, predicted from samples of pose and landmark.

    Parameters
    ----------
    z : (N, 2) mean predicted range [m] and bearing [rad]
    S : (N, 2, 2) its covariance, without measurement noise
    """

    z: np.ndarray
    S: np.ndarray


def expected_scan(x, p, weights):
    """Mean and covariance of the expected (predicted) observations of landmarks.

    Parameters
    ----------
    x : (n, 3) poses [m, m, rad]
    p : (n, N, 2) a position of every landmark for each of these poses [m]
    weights : (n,) that sum to one

    Returns
    -------
    ExpectedScan
    """
    z = h(x[:, None], p)
    first = z[0].copy()
    deviations = z - first
    deviations[..., 1] = wrap(deviations[..., 1])
    mean = np.einsum("i,ijk->jk", weights, deviations)
    deviations -= mean
    at = first + mean
    at[:, 1] = wrap(at[:, 1])
    return ExpectedScan(at, np.einsum("i,ijk,ijl->jkl", weights, deviations, deviations))


def associate(z, R, seen, probability=0.99, new=0.9999):
    """Greedy nearest-neighbour data association, each landmark with at most one observation.

    The squared Mahalanobis distance vᵀ (S + R)⁻¹ v is χ² with 2 degrees of freedom. Inside the gate
    of a landmark it is the landmark, outside of every far gate it is new, and what lies between is
    ambiguous: neither.

    Parameters
    ----------
    z : (m, 2) range [m] and bearing [rad]
    R : (m, 2, 2)
    seen : ExpectedScan of N landmarks
    probability : float, of a true pairing to pass the gate
    new : float, of a true pairing to pass the far gate

    Returns
    -------
    {row of z: row of landmarks}
    list of rows of z that are new
    """
    m, N = len(z), len(seen.z)
    if not N:
        return {}, list(range(m))
    v = z[:, None] - seen.z
    v[..., 1] = wrap(v[..., 1])
    S = seen.S + R[:, None]
    d2 = np.einsum("ijk,ijk->ij", v, np.linalg.solve(S, v[..., None])[..., 0])
    return gated_nearest_neighbours(d2, -2 * log(1 - probability), -2 * log(1 - new))
