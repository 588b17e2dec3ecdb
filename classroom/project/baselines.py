"""Baseline estimators of the library, run on the same worlds as a student's estimator."""

import numpy as np

from slamlab.estimators.dead_reckoning import DeadReckoning
from slamlab.estimators.graph_slam import GraphSlam
from slamlab.estimators.icp_slam import IcpSlam
from slamlab.layers import Points
from slamlab.models.parameters import RobotModel

CELL = 0.05  # cell size of the grid that thins the points of a map [m]
ROBOT = RobotModel(distance_error=0.005, turn_error=0.01, turn_per_metre=0.03, slip=0.012, base=0.3)
"""Odometry errors as the families draw them; students know these values, too."""


class Baseline:
    """An estimator of the library with the interface of a student's estimator."""

    def __init__(self, estimator):
        self._estimator = estimator
        self.step, self.trajectory = estimator.step, estimator.trajectory

    @property
    def pose(self):
        """The current estimated pose, (3,) [m, m, rad]."""
        return self._estimator.pose

    def map(self):
        """Return the points of the map, thinned: (n, 2) [m]."""
        clouds = [layer for layer in self._estimator.layers() if isinstance(layer, Points)]
        points = clouds[-1].xy  # of two maps, the first is that of odometry
        cells = np.floor(points / CELL)
        return points[np.unique(cells, axis=0, return_index=True)[1]]


BASELINES = {
    "odometry": lambda: Baseline(DeadReckoning()),
    "icp": lambda: Baseline(IcpSlam()),
    "graph": lambda: Baseline(GraphSlam(ROBOT)),
}
"""Baselines by name, from the worst to the best: the reference points of the scale."""
