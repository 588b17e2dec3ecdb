"""Devices whose revolutions and poses are ready."""

import numpy as np

from slamlab.devices.emir import Calibration
from slamlab.devices.emir.wheel_odometry import Odometry
from slamlab.devices.rplidar.revolutions import Revolution


def turn(end, complete=True):
    angles = np.arange(0, 360, 1.0)
    times = end - 0.1 + 0.1 * np.arange(1, 361) / 360
    ones = np.ones(360, int)
    return Revolution(
        angles, 1000.0 * ones, ones, times, complete, int(not complete), False, 2.8e-4
    )


class ReadyLidar:
    """A lidar whose turns are made already."""

    name = "lidar"

    def __init__(self, turns, error=None):
        self._revolutions, self._error, self.closed = turns, error, False

    def __iter__(self):
        yield from self._revolutions
        if self._error is not None:
            raise self._error

    def close(self):
        self.closed = True


class ReadyEmir:
    """A robot that has driven already: a count ahead and one to the left every 0.1 s."""

    name, error = "emir", None

    def __init__(self):
        self.driven, self.closed, self.renewed = [], False, 0
        self.odometry = Odometry(Calibration())
        for k in range(100):
            self.odometry.advance(k, k, 50.0 + 0.1 * k)
        self.pose_at = self.odometry.pose_at

    def drive(self, v, omega):
        self.driven.append((v, omega))

    def renew(self):
        self.renewed += 1

    def close(self):
        self.closed = True
