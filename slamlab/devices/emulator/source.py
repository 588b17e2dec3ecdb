"""Emulated devices as a source of readings: real drivers, ports between, and the truth is known."""

import os

import numpy as np

from slamlab.devices.closing import closed_at_exit
from slamlab.devices.emir import Emir
from slamlab.devices.emulator.bench import EMIR, LIDAR, bench
from slamlab.devices.errors import SlamlabError
from slamlab.devices.rplidar import Lidar
from slamlab.devices.source import Devices
from slamlab.geometry import between
from slamlab.readings import Trajectory
from slamlab.sources.base import SourceError

WHERE = None if os.name == "posix" else ("127.0.0.1", 0, 0)  # TCP where no pseudo-terminals are


class Emulated(Devices):
    """An emulated RPLIDAR on an emulated eMIR, opened by their ports; closes drivers and emulators.

    Parameters
    ----------
    world : World
    rng : numpy.random.Generator, of noise and slip
    calibration : Calibration that the driver is to believe; the thesis' by default

    ``bench`` are the emulators, ``truth`` where the robot was at each reading, from the first.

    Raises
    ------
    SourceError
    """

    def __init__(self, world, rng, calibration=None):
        try:
            self.bench = bench(world, rng, WHERE)
        except SlamlabError as error:
            raise SourceError(str(error)) from error
        self.world, self._at, self._poses = world, [], []
        try:
            emir = Emir(self.bench.ports[EMIR], calibration=calibration)
            super().__init__(Lidar(self.bench.ports[LIDAR]), emir)
            closed_at_exit(self)
        except SlamlabError as error:
            self.bench.close()  # a robot that was opened ends with its port
            raise SourceError(str(error)) from error

    @property
    def truth(self):
        """Trajectory, see there; of the readings so far."""
        poses = np.reshape(self._poses, (-1, 3))
        times = np.array(self._at[: len(poses)])
        return Trajectory(times - times[:1], between(poses[:1], poses))

    def close(self):
        """Stop the robot, close the drivers, pull the plugs; may be called again."""
        super().close()
        self.bench.close()

    def _scan(self, turn):
        self._at.append(float(turn.times[-1]))
        self._poses.append(self.bench.body.pose_at(turn.times[-1:])[0])
        return super()._scan(turn)
