"""Live devices as a source (online SLAM): a lidar, with or without a robot."""

from dataclasses import replace

import numpy as np

from slamlab import devices as drivers
from slamlab.devices.emir import Emir
from slamlab.devices.emir.driver import WATCHDOG_TIMEOUT
from slamlab.devices.errors import SlamlabError
from slamlab.devices.transport import open_port
from slamlab.files import SourceError
from slamlab.sources.base import checked_command
from slamlab.sources.lidar_on_robot import LidarOnRobot


class LiveDevices(LidarOnRobot):
    """Live readings of a lidar, with or without an eMIR robot; close() closes all devices.

    Each reading renews the robot's command watchdog. If ``renewed_by_readings`` is False, only
    :meth:`renew` renews the watchdog.
    """

    renewed_by_readings = True

    def __init__(self, lidar, emir=None, front=0.0, prefix="devices:"):
        devices = [device for device in (lidar, emir) if device is not None]
        super().__init__(prefix + ",".join(device.name for device in devices), front)
        self.sensor = getattr(lidar, "sensor", self.sensor)
        self.lidar, self.emir, self._command = lidar, emir, None
        self.has_odometry = emir is not None

    def __iter__(self):
        try:
            for reading in super().__iter__():
                yield replace(reading, control=self._command)
        except SlamlabError as error:
            raise SourceError(str(error)) from error

    @property
    def drivable(self):
        return self.emir is not None

    def drive(self, command):
        if self.emir is None:
            raise SourceError(f"{self.name} has no robot and cannot be driven")
        v, omega = checked_command(command)
        try:
            self.emir.drive(v, omega)
        except SlamlabError as error:
            raise SourceError(str(error)) from error
        self._command = np.array([v, omega])

    def renew(self):
        if self.emir is not None:
            self.emir.renew()

    def close(self):
        if self.emir is not None:
            self.emir.close()
        self.lidar.close()

    def _revolutions(self):
        for revolution in self.lidar:
            warnings = getattr(self.lidar, "warnings", ())  # optional attribute of a driver
            self.notes += [warning for warning in warnings if warning not in self.notes]
            dropped = getattr(self.lidar, "stats", {}).get("revolutions dropped", 0)
            if dropped:  # the consumer is slower than the lidar (back-pressure)
                self.damage["revolutions dropped"] = self.skipped = dropped
            if self.emir is not None:
                if self.emir.error is not None:
                    raise self.emir.error
                if self.renewed_by_readings:
                    self.emir.renew()
            yield revolution

    def _pose_at(self, time):
        return self.emir.pose_at(time)


def devices(
    ports,
    calibration=None,
    front=0.0,
    reconnect=False,
    watchdog=WATCHDOG_TIMEOUT,
    openers=(open_port, open_port),
    prefix="devices:",
):
    """Open the ports ``"LIDAR_PORT,EMIR_PORT"`` as LiveDevices. Raises SourceError.

    The second port is optional; if the first is empty, the lidar's port is detected. ``watchdog``
    is the timeout of the command watchdog [s], ``openers`` open the transports of lidar and robot,
    and ``prefix`` is one of LIDARS.
    """
    names = [name.strip() for name in ports.split(",")]
    if len(names) > 2:
        raise SourceError(f"{prefix}LIDAR_PORT,EMIR_PORT takes at most two ports, not {len(names)}")
    (lidar_opener, robot_opener), emir = openers, None
    try:
        if len(names) == 2 and names[1]:
            options = {"opener": robot_opener, "reconnect": reconnect, "watchdog": watchdog}
            emir = Emir(names[1], calibration=calibration, **options)
        driver = getattr(drivers, drivers.LIDARS[prefix])
        lidar = driver(names[0] or None, opener=lidar_opener, reconnect=reconnect)
        return LiveDevices(lidar, emir, front, prefix)
    except SlamlabError as error:
        if emir is not None:
            emir.close()
        raise SourceError(str(error)) from error
