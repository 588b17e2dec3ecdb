"""Simulated hand-held lidar in a flat as a source: with motion distortion, without odometry."""

import numpy as np

from slamlab.devices.emulator.motion_distortion import MovingLidar
from slamlab.geometry import between, wrap
from slamlab.readings import Reading, Scan, Trajectory
from slamlab.simulation.pedestrians import carrier
from slamlab.simulation.range_scanners import RPLIDARS
from slamlab.sources.base import SimulatedRun

CARRIED = "-carried"  # suffix of the flat's name


class HandheldLidar(SimulatedRun):
    """Simulation of a hand-held lidar in a flat; each beam is measured from a different pose.

    lidar : Scanner; walking : options of :func:`slamlab.simulation.pedestrians.carrier`.
    """

    has_odometry = False

    def __init__(self, flat, rng, lidar=RPLIDARS["A2"], **walking):
        super().__init__(rng)
        self.name, self.lidar, self.sensor = f"sim:{flat}{CARRIED}", lidar, lidar.model
        self.body = carrier(flat, self._rng(0), begin=0.0, **walking)
        self.world, self.walk = self.body.world, self.body.walk
        self._measure = MovingLidar(self.body, self._rng(1), lidar)
        self._since_end = np.arange(1 - lidar.beams, 1) / (lidar.beams * lidar.rate)  # beams' [s]
        self._clockwise = np.arange(lidar.beams) * 360 / lidar.beams  # [degree]
        self._times = np.arange(1, int(self.walk.duration * lidar.rate) + 1) / lidar.rate

    def __len__(self):
        return len(self._times)

    @property
    def truth(self):
        poses = self.walk.pose_at(self._times)
        return Trajectory(self._times, between(poses[0], poses))

    def _reading(self, i):
        lidar, since_end, time = self.lidar, self._since_end.copy(), float(self._times[i])
        ranges = self._measure(time + since_end, self._clockwise) / 1000
        ranges[ranges == 0] = np.nan
        angles = wrap(-np.radians(self._clockwise))
        scan = Scan(angles, ranges, lidar.range_max, lidar.range_min, times=since_end)
        return Reading(time, scan=scan)
