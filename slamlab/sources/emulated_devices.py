"""Emulated devices as a source (software in the loop): real drivers and ground truth."""

import os

import numpy as np

from slamlab.devices.emir import Emir
from slamlab.devices.emulator.emulator_runner import EMIR, LIDAR, run_emulators
from slamlab.devices.errors import SlamlabError
from slamlab.devices.rplidar import RPLidar
from slamlab.devices.shutdown import close_at_exit
from slamlab.files import SourceError
from slamlab.geometry import between
from slamlab.readings import Trajectory
from slamlab.simulation.pedestrians import carrier
from slamlab.sources.live_devices import LiveDevices

# TCP ports on a system without pseudo-terminals
FALLBACK_ADDRESS = None if os.name == "posix" else ("127.0.0.1", 0, 0)


class EmulatedDevices(LiveDevices):
    """Emulated RPLIDAR on an emulated eMIR robot, and their drivers. Raises SourceError.

    With a SimulatedClock, a run is reproducible on any machine, because time advances only while
    the program waits for a reading. ``calibration`` is for the robot's driver. ``carried`` means a
    hand-held lidar in a flat, without a robot; the readings end with the walk.
    """

    def __init__(self, world, rng, calibration=None, clock=None, carried=False):
        try:
            by = carrier(world.name, rng.spawn(1)[0]) if carried else None
            self.bench = run_emulators(world, rng, FALLBACK_ADDRESS, clock=clock, carrier=by)
        except (SlamlabError, ValueError) as error:
            raise SourceError(str(error)) from error
        self.world, self._times, self._poses = world, [], []
        self._last = by.walk.duration if carried else np.inf  # time of the last reading [s]
        shared = {"opener": self.bench.opener, "clock": self.bench.clock}
        try:
            emir = None
            if not carried:
                emir = Emir(self.bench.ports[EMIR], calibration=calibration, **shared)
            super().__init__(RPLidar(self.bench.ports[LIDAR], **shared), emir)
            close_at_exit(self)
        except SlamlabError as error:
            self.bench.close()  # closes the port of a robot that is already open
            raise SourceError(str(error)) from error

    @property
    def truth(self):
        poses = np.reshape(self._poses, (-1, 3))
        times = np.array(self._times[: len(poses)])
        return Trajectory(times - times[:1], between(poses[:1], poses))

    def close(self):
        super().close()
        self.bench.close()

    def _revolutions(self):
        for revolution in super()._revolutions():
            yield revolution
            if self._times and revolution.times[-1] - self._times[0] > self._last:
                return

    def _scan(self, revolutions):
        end = revolutions[-1].times[-1:]
        self._times.append(float(end[0]))
        self._poses.append(self.bench.body.pose_at(end)[0])
        return super()._scan(revolutions)
