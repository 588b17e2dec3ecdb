"""Data association for particle filters: a validation gate by the covariance of the particles."""

from dataclasses import dataclass
from math import log

import numpy as np

from slamlab.filters.data_association import gated_nearest_neighbours
from slamlab.filters.landmark_models import difference
from slamlab.geometry import wrap
from slamlab.models.observation import h


@dataclass(frozen=True)
class ExpectedScan:
    """Expected observations: mean z (N, 2) [m, rad]; covariance S (N, 2, 2), R not included."""

    z: np.ndarray
    S: np.ndarray


def expected_scan(x, p, weights):
    """Return the ExpectedScan of N landmarks from poses x (n, 3) with landmarks p (n, N, 2)."""
    z = h(x[:, None], p)
    deviations = difference(z, z[0])
    mean = np.einsum("i,ijk->jk", weights, deviations)
    deviations -= mean
    at = z[0] + mean
    at[:, 1] = wrap(at[:, 1])
    return ExpectedScan(at, np.einsum("i,ijk,ijl->jkl", weights, deviations, deviations))


def associate(z, R, seen, probability=0.99, new=0.9999):
    """Associate greedily with the landmark of least vᵀ (S + R)⁻¹ v, χ² (2 degrees of freedom).

    probability : that a true pair passes the validation gate; new : the same for the wider gate,
    outside which an observation belongs to a new landmark. Returns the pairs {row of z: landmark}
    and the rows of z for new landmarks.
    """
    m, N = len(z), len(seen.z)
    if not N:
        return {}, list(range(m))
    v = difference(z[:, None], seen.z)
    S = seen.S + R[:, None]
    d2 = np.einsum("ijk,ijk->ij", v, np.linalg.solve(S, v[..., None])[..., 0])
    return gated_nearest_neighbours(d2, -2 * log(1 - probability), -2 * log(1 - new))
