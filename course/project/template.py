"""Template of the final project: a complete estimator that uses odometry alone."""

import numpy as np

from slamlab.geometry import compose, transform


class MySlam:
    """Dead reckoning: the odometry increments are composed, and each scan is placed at the result."""

    def __init__(self):
        self.pose = np.zeros(3)
        self.covariance = None  # (3, 3) of the pose, once you can estimate it
        self._poses, self._scans = [], []

    def step(self, reading):
        """Process a reading: an odometry increment, and usually a scan."""
        self.pose = compose(self.pose, reading.odometry)
        self._poses.append(self.pose)
        points = np.empty((0, 2)) if reading.scan is None else reading.scan.points()
        self._scans.append(points)

    def trajectory(self):
        """Return the current estimates of all poses, (n, 3)."""
        return np.array(self._poses)

    def map(self):
        """Return the points of the map, (n, 2)."""
        clouds = [transform(p, scan) for p, scan in zip(self._poses, self._scans, strict=True)]
        points = np.concatenate([np.empty((0, 2)), *clouds])
        # one point per cell of 5 cm is enough
        return points[np.unique(np.floor(points / 0.05), axis=0, return_index=True)[1]]
