"""Centroids as origins of point clouds that are far from the origin, such as in map coordinates.
Far from the origin, a rotation and a translation have nearly the same effect (ill-conditioned)."""

from dataclasses import dataclass
from math import cos, sin

import numpy as np

FAR = 5.0  # distance of the centroid from the origin, in root mean square radii of the cloud [1]
ORIGIN = 0.0, 0.0


def distant_centroid(x, y):
    """Return the centroid (2,) of points that are far from the origin, otherwise the origin."""
    n = len(x)
    cx, cy = float(np.add.reduce(x)) / n, float(np.add.reduce(y)) / n
    away = cx * cx + cy * cy
    variance = float(x @ x + y @ y) / n - away  # may be negative by rounding if it is far
    return (cx, cy) if away > FAR**2 * variance else ORIGIN


@dataclass(frozen=True)
class Centroids:
    """Centroids (2,) of a source and its target, used as their origins [m]."""

    source: tuple
    target: tuple

    @classmethod
    def of(cls, source, target):
        """Return the Centroids of two clouds (n, 2), (m, 2)."""
        return cls(distant_centroid(*source.T), distant_centroid(*target.T))

    def inward(self, pose):
        """Return the pose of the source in the target's frame, relative to the centroids."""
        x, y, theta = pose
        dx, dy = self._turned(theta)
        return np.array([x + (dx - self.target[0]), y + (dy - self.target[1]), theta])

    def outward(self, pose):
        """Return the pose relative to the original frames, the inverse of ``inward``."""
        x, y, theta = pose
        dx, dy = self._turned(theta)
        return np.array([x + (self.target[0] - dx), y + (self.target[1] - dy), theta])

    def outward_covariance(self, P, theta):
        """Return the covariance (3, 3) of the ``outward`` pose."""
        dx, dy = self._turned(theta)
        J = np.array([[1.0, 0.0, dy], [0.0, 1.0, -dx], [0.0, 0.0, 1.0]])
        return J @ P @ J.T

    def _turned(self, theta):
        c, s = cos(theta), sin(theta)
        x, y = self.source
        return c * x - s * y, s * x + c * y
