"""Dead reckoning: odometry summed up, the estimate that SLAM has to beat."""

import numpy as np

from slamlab.estimators.base import Estimator
from slamlab.geometry import compose, transform
from slamlab.layers import Points, Poses


class Odometry(Estimator):
    """Believes the odometry and draws each scan where it says the robot is."""

    def __init__(self):
        super().__init__()
        self._map = []

    def step(self, reading):
        """Move by the reading's odometry.

        Parameters
        ----------
        reading : Reading
        """
        moved = np.any(np.asarray(reading.odometry) != 0)
        self.pose = compose(self.pose, reading.odometry)
        if reading.scan is not None and (moved or not self._map):
            self._map.append(transform(self.pose, reading.scan.points()))
        self.record(reading.time)

    def layers(self):
        """The map, the track."""
        points = np.concatenate([np.empty((0, 2)), *self._map])
        return [Points("map", points), Poses("naive", self.trajectory().poses)]
