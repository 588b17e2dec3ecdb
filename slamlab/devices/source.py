"""A lidar and a robot as a source of readings: what a SLAM takes in, live."""

import numpy as np

from slamlab.devices.deskew import deskewed
from slamlab.devices.emir import Emir
from slamlab.devices.errors import SlamlabError
from slamlab.devices.rplidar import Lidar
from slamlab.geometry import between
from slamlab.hardware import RobotModel
from slamlab.readings import Reading
from slamlab.sensors import RPLIDAR_A2
from slamlab.sources.base import Source, SourceError

EMIR = RobotModel(distance_error=0.05, turn_error=0.08, turn_per_metre=0.1, radius=0.15)
"""eMIR's odometry: programs for it disagree by 3 % in the way and by 7 % in the turn."""


class Devices(Source):
    """Readings of an RPLIDAR and an eMIR, on one clock: each turn, and the way since the last.

    Ends when it is closed. Both devices are its own: it closes them.

    Parameters
    ----------
    lidar : Lidar
    emir : Emir, or None for a lidar that is carried or stands
    front : float, where the robot's front lies for the lidar, clockwise [degree]
    """

    robot = EMIR

    def __init__(self, lidar, emir=None, front=0.0):
        super().__init__()
        self.lidar, self.emir, self.front = lidar, emir, front
        self.name = "devices:" + ",".join(d.name for d in (lidar, emir) if d is not None)
        self.sensor = RPLIDAR_A2.model
        self._command = None

    def __iter__(self):
        begin = last = None
        try:
            for turn in self.lidar:
                time = float(turn.times[-1])
                begin = time if begin is None else begin
                pose = np.zeros(3) if self.emir is None else self.emir.pose_at(time)
                odometry = np.zeros(3) if last is None else between(last, pose)
                last = pose
                self.damage["turns with a gap"] += not turn.complete
                self._check()
                yield Reading(time - begin, odometry, self._scan(turn), control=self._command)
        except SlamlabError as error:
            raise SourceError(str(error)) from error

    @property
    def drivable(self):
        """bool, whether there is a robot."""
        return self.emir is not None

    def drive(self, command):
        """Set the robot going; its readings come in their own time.

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

    def close(self):
        """Stop robot and lidar and let go of their ports."""
        if self.emir is not None:
            self.emir.close()
        self.lidar.close()

    def _scan(self, turn):
        """The turn as a scan from where it ended."""
        scan = turn.scan(self.sensor.range_max, self.sensor.range_min, self.front)
        if self.emir is None:
            return scan
        first, last = (self.emir.pose_at(float(t)) for t in turn.times[[0, -1]])
        return deskewed(scan, turn.times, first, last)

    def _check(self):
        if self.emir is not None and self.emir.error is not None:
            raise self.emir.error


def devices(ports):
    """Open a lidar and a robot.

    Parameters
    ----------
    ports : str, LIDAR_PORT,EMIR_PORT; without the second the lidar alone; an empty first finds it

    Returns
    -------
    Devices

    Raises
    ------
    SourceError : why it does not work, and what to do
    """
    names = [name.strip() for name in ports.split(",")]
    if len(names) > 2:
        raise SourceError(f"devices:LIDAR_PORT,EMIR_PORT names two ports, not {len(names)}")
    emir = None
    try:
        if len(names) == 2 and names[1]:
            emir = Emir(names[1])
        return Devices(Lidar(names[0] or None), emir)
    except SlamlabError as error:
        if emir is not None:
            emir.close()
        raise SourceError(str(error)) from error
