"""Emulated devices as a source (software in the loop): real drivers, known ground truth."""

import os

import numpy as np

from slamlab.devices.emir import Emir
from slamlab.devices.emulator.emulator_runner import EMIR, LIDAR, run_emulators
from slamlab.devices.errors import SlamlabError
from slamlab.devices.rplidar import RPLidar
from slamlab.devices.shutdown import close_at_exit
from slamlab.files.errors import SourceError
from slamlab.geometry import between
from slamlab.readings import Trajectory
from slamlab.sources.live_devices import LiveDevices

# TCP ports where there are no pseudo-terminals
FALLBACK_ADDRESS = None if os.name == "posix" else ("127.0.0.1", 0, 0)


class EmulatedDevices(LiveDevices):
    """Emulated RPLIDAR on an emulated eMIR robot, and their drivers; closes drivers, emulators.

    They run in real time, behind ports, or in a simulated time which passes only while a reading is
    waited for: then no turn is ever dropped, and a drive is the same on any machine.

    Parameters
    ----------
    world : World
    rng : numpy.random.Generator, of noise and slip
    calibration : Calibration that the driver is to believe; the thesis' by default
    clock : SimulatedClock, or None for real time

    ``bench`` are the emulators, ``truth`` where the robot was at each reading, from the first.

    Raises
    ------
    SourceError
    """

    def __init__(self, world, rng, calibration=None, clock=None):
        try:
            self.bench = run_emulators(world, rng, FALLBACK_ADDRESS, clock=clock)
        except SlamlabError as error:
            raise SourceError(str(error)) from error
        self.world, self._times, self._poses = world, [], []
        shared = {"opener": self.bench.opener, "clock": self.bench.clock}
        try:
            emir = Emir(self.bench.ports[EMIR], calibration=calibration, **shared)
            super().__init__(RPLidar(self.bench.ports[LIDAR], **shared), emir)
            close_at_exit(self)
        except SlamlabError as error:
            self.bench.close()  # a robot that was opened ends with its port
            raise SourceError(str(error)) from error

    @property
    def truth(self):
        """Ground truth (Trajectory): the true poses of the readings so far."""
        poses = np.reshape(self._poses, (-1, 3))
        times = np.array(self._times[: len(poses)])
        return Trajectory(times - times[:1], between(poses[:1], poses))

    def close(self):
        """Stop the robot, close the drivers, close the emulated ports; may be called again."""
        super().close()
        self.bench.close()

    def _scan(self, turns):
        end = turns[-1].times[-1:]
        self._times.append(float(end[0]))
        self._poses.append(self.bench.body.pose_at(end)[0])
        return super()._scan(turns)


Emulated = EmulatedDevices  # name in the first edition
