"""Live devices as a source: readings of a lidar and a robot in real time (online SLAM)."""

from dataclasses import replace

import numpy as np

from slamlab.devices.emir import Emir
from slamlab.devices.emir.driver import WATCHDOG_TIMEOUT
from slamlab.devices.errors import SlamlabError
from slamlab.devices.rplidar import RPLidar
from slamlab.devices.transport import open_port
from slamlab.files.errors import SourceError
from slamlab.sources.lidar_on_robot import LidarOnRobot


class LiveDevices(LidarOnRobot):
    """Live source: readings of an RPLIDAR and an eMIR robot, as they come.

    Ends when it is closed. Both devices are its own: it closes them. The robot drives on as
    commanded only while readings are taken: see :class:`Emir`. Where ``renewed_by_readings`` is
    set to False, only while somebody calls :meth:`renew`.

    Parameters
    ----------
    lidar : RPLidar
    emir : Emir, or None for a lidar that is carried or stands
    front : float, where the robot's front lies for the lidar, clockwise [degree]
    """

    renewed_by_readings = True

    def __init__(self, lidar, emir=None, front=0.0):
        there = [device for device in (lidar, emir) if device is not None]
        super().__init__("devices:" + ",".join(device.name for device in there), front)
        self.lidar, self.emir, self._command = lidar, emir, None

    def __iter__(self):
        try:
            for reading in super().__iter__():
                yield replace(reading, control=self._command)
        except SlamlabError as error:
            raise SourceError(str(error)) from error

    @property
    def drivable(self):
        """bool, whether there is a robot that takes drive commands."""
        return self.emir is not None

    def drive(self, command):
        """Drive the robot by a velocity command; its readings come in real time.

        Parameters
        ----------
        command : (2,) speed v, turn rate omega [m/s, rad/s]

        Raises
        ------
        SourceError : no two finite numbers, no robot, or none any more
        """
        if self.emir is None:
            raise SourceError(f"{self.name} has no robot: it cannot be driven")
        try:
            v, omega = (float(number) for number in command)
            if not np.isfinite([v, omega]).all():
                raise ValueError
        except (TypeError, ValueError):
            raise SourceError(
                f"a command is speed and turn rate [m/s, rad/s], not {command!r}"
            ) from None
        try:
            self.emir.drive(v, omega)
        except SlamlabError as error:
            raise SourceError(str(error)) from error
        self._command = np.array([v, omega])

    def renew(self):
        """See :meth:`Source.renew`: it goes to the robot's command watchdog."""
        if self.emir is not None:
            self.emir.renew()

    def close(self):
        """Close the devices: stop robot and lidar, release their ports."""
        if self.emir is not None:
            self.emir.close()
        self.lidar.close()

    def _turns(self):
        """Turns of the lidar; who asks for one wants the robot to drive on."""
        for turn in self.lidar:
            if self.emir is not None:
                if self.emir.error is not None:
                    raise self.emir.error
                if self.renewed_by_readings:
                    self.emir.renew()
            yield turn

    def _pose_at(self, time):
        return np.zeros(3) if self.emir is None else self.emir.pose_at(time)


def devices(
    ports,
    calibration=None,
    front=0.0,
    reconnect=False,
    watchdog=WATCHDOG_TIMEOUT,
    openers=(open_port, open_port),
    clock=None,
):
    """Open a lidar and a robot by their serial ports, as a live source.

    Parameters
    ----------
    ports : str, LIDAR_PORT,EMIR_PORT; without the second the lidar alone; an empty first finds it
    calibration : Calibration of the robot
    front : float, where the robot's front lies for the lidar, clockwise [degree]
    reconnect : bool, whether lost connections are tried again until they are back
    watchdog : float, after which a motion that is not renewed ends [s]
    openers : two callables(port, baud) -> Transport, of lidar and robot
    clock : Clock of both

    Returns
    -------
    LiveDevices

    Raises
    ------
    SourceError : why it does not work, and what to do
    """
    names = [name.strip() for name in ports.split(",")]
    if len(names) > 2:
        raise SourceError(f"devices:LIDAR_PORT,EMIR_PORT names two ports, not {len(names)}")
    shared, emir = {"reconnect": reconnect, "clock": clock}, None
    of_lidar, of_robot = openers
    try:
        if len(names) == 2 and names[1]:
            robot = {"calibration": calibration, "watchdog": watchdog, "opener": of_robot}
            emir = Emir(names[1], **robot, **shared)
        return LiveDevices(RPLidar(names[0] or None, opener=of_lidar, **shared), emir, front)
    except SlamlabError as error:
        if emir is not None:
            emir.close()
        raise SourceError(str(error)) from error
