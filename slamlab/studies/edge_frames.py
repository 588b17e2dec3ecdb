"""In which frame an edge errs: matches of scans at a given turn, for lesson 15."""

from dataclasses import dataclass

import numpy as np

from slamlab.geometry import compose
from slamlab.posegraph import edge_error
from slamlab.scanmatching import match
from slamlab.simulation.range_scanners import RPLIDAR_A2

WAY = 0.4, 0.1  # from the old scan to the new one, in the frame of the old [m]
PLACES = [3.5, -0.3], [4.5, 0.3]  # of the old scan: corners of a piece of corridor along x [m]


@dataclass(frozen=True)
class Matches:
    """Errors of matches, as an edge between the true poses has them, and what is claimed of them.

    Parameters
    ----------
    e : (n, 3) the edge's error [m, m, rad]
    R : (n, 3, 3) covariance of the measured motion, in the frame of the old pose
    information : (n, 3, 3) that of e, turned into its frame
    """

    e: np.ndarray
    R: np.ndarray
    information: np.ndarray

    def of_e(self):
        """Covariance (n, 3, 3) of e."""
        return np.linalg.inv(self.information)

    def nees(self):
        """Mean NEES of e, 3 where the claim is right: taking R for its covariance, and turned."""
        by_z = np.linalg.inv(self.R)
        return tuple(
            float(np.einsum("na,nab,nb->n", self.e, by, self.e).mean())
            for by in (by_z, self.information)
        )


def matches(world, degrees, count=60):
    """Match pairs of scans, the new one turned against the old one.

    Parameters
    ----------
    world : World, with a corridor along x from the origin
    degrees : int, the turn between the two scans
    count : int, pairs

    Returns
    -------
    Matches
    """
    rows = []
    for k in range(count):
        rng = np.random.default_rng([15, degrees, k])
        m = np.array([*WAY, np.radians(degrees)])
        old = np.array([*rng.uniform(*PLACES), 0.0])
        at = old, compose(old, m)
        seen, before = (RPLIDAR_A2.scan(world, pose, rng).points() for pose in at[::-1])
        found = match(seen, before, m)
        R = found.covariance
        rows.append((edge_error.error(*at, found.pose), R, edge_error.information(found.pose, R)))
    return Matches(*(np.array(each) for each in zip(*rows, strict=True)))
