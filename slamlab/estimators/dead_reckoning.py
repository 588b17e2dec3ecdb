"""Dead reckoning: odometry increments composed, the estimate that SLAM has to beat."""

import numpy as np

from slamlab.estimators.base import Estimator
from slamlab.estimators.growing_rows import GrowingRows
from slamlab.geometry import compose, transform
from slamlab.layers import Points, Poses


class DeadReckoning(Estimator):
    """Dead reckoning by odometry alone; each scan is drawn at the pose so far (naive map)."""

    def __init__(self):
        super().__init__()
        self._map = GrowingRows(2)

    def step(self, reading):
        """Compose the pose with the reading's odometry increment.

        Parameters
        ----------
        reading : Reading
        """
        reading = self.usable(reading)
        moved = np.any(np.asarray(reading.odometry) != 0)
        self.pose = compose(self.pose, reading.odometry)
        if reading.scan is not None and (moved or not len(self._map.rows)):
            self._map.append(transform(self.pose, reading.scan.points()))
        self.record(reading.time)
        self.status = self.status_line()

    def layers(self):
        """The naive map and trajectory."""
        return [Points("map", self._map.rows), Poses("naive", self.trajectory().poses)]


Odometry = DeadReckoning  # name in the first edition
