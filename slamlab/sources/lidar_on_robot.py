"""A lidar on a robot: readings of its scans (turns) and odometry, synchronised on one clock.

The odometry is interpolated at the times of the beams; scans are deskewed by it, and merged.
"""

import numpy as np

from slamlab.devices.deskewing import deskew, merge
from slamlab.files.errors import SourceError
from slamlab.geometry import between
from slamlab.models.parameters import RobotModel
from slamlab.readings import Reading
from slamlab.simulation.range_scanners import RPLIDAR_A2
from slamlab.sources.base import Source

EMIR_MODEL = RobotModel(distance_error=0.05, turn_error=0.08, turn_per_metre=0.1, radius=0.15)
"""Robot model of the eMIR: programs for it disagree by 3 % in distance and by 7 % in turn."""


class LidarOnRobot(Source):
    """Source of a lidar on a robot: deskewed scans, each with the odometry increment since.

    Subclasses say which turns there are and where the robot was.

    Parameters
    ----------
    name : str
    front : float, where the robot's front lies for the lidar, clockwise [degree]
    """

    robot, sensor = EMIR_MODEL, RPLIDAR_A2.model
    merged = 1  # turns in the scan of one reading

    def __init__(self, name, front=0.0):
        super().__init__()
        self.name, self.front = name, front

    def merge(self, turns):
        """Merge turns into one scan: see :meth:`Source.merge`."""
        if not (isinstance(turns, int) and turns >= 1):
            raise SourceError(f"one turn or more can be merged into a scan, not {turns!r}")
        self.merged = turns

    def __iter__(self):
        begin = last = None
        for turns in self._groups():
            time = float(turns[-1].times[-1])
            pose = self._pose_at(time)
            begin = time if begin is None else begin
            odometry = np.zeros(3) if last is None else between(last, pose)
            last = pose
            yield Reading(time - begin, odometry, self._scan(turns))

    def _turns(self):
        """Yield each Turn when it is known where the robot was."""
        raise NotImplementedError

    def _pose_at(self, time):
        """(3,) odometry pose of the robot, interpolated at a time [m, m, rad]."""
        raise NotImplementedError

    def _scan(self, turns):
        """Deskewed scan of some turns, as from the pose where the last ended."""
        scans, ends = [], []
        for turn in turns:
            scan = turn.scan(self.sensor.range_max, self.sensor.range_min, self.front)
            first, last = (self._pose_at(float(time)) for time in turn.times[[0, -1]])
            scans.append(deskew(scan, turn.times, first, last))
            ends.append(last)
        return merge(scans, ends)

    def _groups(self):
        """Turns, as many at a time as are merged; what is left at the end, too."""
        group = []
        for turn in self._turns():
            self._count_damage(turn)
            group.append(turn)
            if len(group) == self.merged:
                yield group
                group = []
        if group:
            yield group

    def _count_damage(self, turn):
        if not turn.complete:
            self.damage["turns with a gap"] += 1
        if turn.after_gap:
            self.damage["connections lost and found"] += 1
