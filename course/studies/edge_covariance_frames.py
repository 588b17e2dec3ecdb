"""Frame of a pose-graph edge's covariance: scan matches with a given rotation (lesson 15)."""

from dataclasses import dataclass

import numpy as np

from slamlab.geometry import compose
from slamlab.posegraph import edge_error
from slamlab.scanmatching import match
from slamlab.simulation.range_scanners import RPLIDAR_A2

MOTION = 0.4, 0.1  # from the old scan to the new one, in the frame of the old [m]
AREA = [3.5, -0.3], [4.5, 0.3]  # of the old scan: corners of a piece of corridor along x [m]


@dataclass(frozen=True)
class Matches:
    """Errors e (n, 3) [m, m, rad] of matches used as edges, covariance R (n, 3, 3) of the motion in
    the old pose's frame, and information matrix (n, 3, 3) of e."""

    e: np.ndarray
    R: np.ndarray
    information: np.ndarray

    def of_e(self):
        """Return the covariance (n, 3, 3) of e."""
        return np.linalg.inv(self.information)

    def nees(self):
        """Return the mean NEES of e (3 if the covariance is right) with R and with R rotated."""
        by_z = np.linalg.inv(self.R)
        return tuple(
            float(np.einsum("na,nab,nb->n", self.e, by, self.e).mean())
            for by in (by_z, self.information)
        )


def matches(world, degrees, count=60):
    """Match pairs of scans, the newer of which is rotated, in a world with a corridor along x."""
    rows = []
    for k in range(count):
        rng = np.random.default_rng([15, degrees, k])
        m = np.array([*MOTION, np.radians(degrees)])
        old = np.array([*rng.uniform(*AREA), 0.0])
        at = old, compose(old, m)
        seen, before = (RPLIDAR_A2.scan(world, pose, rng).points() for pose in at[::-1])
        found = match(seen, before, m)
        R = found.covariance
        rows.append((edge_error.error(*at, found.pose), R, edge_error.information(found.pose, R)))
    return Matches(*(np.array(each) for each in zip(*rows, strict=True)))
