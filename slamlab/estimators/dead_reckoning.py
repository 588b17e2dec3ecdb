"""Dead reckoning: odometry alone."""

import numpy as np

from slamlab.estimators.base import Estimator
from slamlab.estimators.growable_array import GrowableArray
from slamlab.geometry import compose, transform
from slamlab.layers import Points, Poses


class DeadReckoning(Estimator):
    """Dead reckoning: composes odometry and draws each scan at the resulting pose (naive map)."""

    def __init__(self):
        super().__init__()
        self._map = GrowableArray(2)

    def step(self, reading):
        reading = self.usable(reading)
        moved = np.any(np.asarray(reading.odometry) != 0)
        self.pose = compose(self.pose, reading.odometry)
        if reading.scan is not None and (moved or not len(self._map.rows)):
            self._map.append(transform(self.pose, reading.scan.points()))
        self.record(reading.time)
        self.status = self.status_line()

    def layers(self):
        return [Points("map", self._map.rows), Poses("naive", self.trajectory().poses)]
