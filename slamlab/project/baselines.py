"""The package's own estimators in the shape of a student's, to be measured on the same drives."""

import numpy as np

from slamlab.estimators.dead_reckoning import DeadReckoning
from slamlab.estimators.graph_slam import GraphSlam
from slamlab.estimators.icp_slam import IcpSlam
from slamlab.layers import Points
from slamlab.models.parameters import RobotModel

CELL = 0.05  # of the points that fall into one cell of a grid one is kept [m]
ROBOT = RobotModel(distance_error=0.005, turn_error=0.01, turn_per_metre=0.03, slip=0.012, base=0.3)
"""Wheels as the families draw them; a student may know as much."""


class Baseline:
    """An estimator of the package with the interface of a student's.

    Parameters
    ----------
    estimator : Estimator
    """

    def __init__(self, estimator):
        self._estimator = estimator
        self.step, self.trajectory = estimator.step, estimator.trajectory

    @property
    def pose(self):
        """The pose as believed now, (3,) [m, m, rad]."""
        return self._estimator.pose

    def map(self):
        """The points of its map, thinned: (n, 2) [m]."""
        clouds = [layer for layer in self._estimator.layers() if isinstance(layer, Points)]
        points = clouds[-1].xy  # the naive one, where there are two, stands before it
        cells = np.floor(points / CELL)
        return points[np.unique(cells, axis=0, return_index=True)[1]]


BASELINES = {
    "odometry": lambda: Baseline(DeadReckoning()),
    "icp": lambda: Baseline(IcpSlam()),
    "graph": lambda: Baseline(GraphSlam(ROBOT)),
}
"""By name, from the worst to the best: the marks of the scale."""
