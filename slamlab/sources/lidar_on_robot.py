"""Lidar on a robot, with scans deskewed (motion compensation) by odometry, or a lidar alone."""

from dataclasses import replace

import numpy as np

from slamlab.deskewing import concatenate_scans, deskew, merge_scans
from slamlab.files import SourceError
from slamlab.geometry import between
from slamlab.models.parameters import RobotModel
from slamlab.readings import Reading
from slamlab.simulation.range_scanners import RPLIDAR_A2
from slamlab.sources.base import Source

# programs for the eMIR differ by 3 % in distance and by 7 % in rotation
EMIR_MODEL = RobotModel(distance_error=0.05, turn_error=0.08, turn_per_metre=0.1, radius=0.15)


class LidarOnRobot(Source):
    """Source of deskewed scans; subclasses yield the revolutions and the odometry poses.

    Without odometry, the scans are not deskewed and contain the times of their beams. ``front`` is
    the angle of the robot's front in the lidar's frame, clockwise [degree].
    """

    robot, sensor = EMIR_MODEL, RPLIDAR_A2.model
    merged = 1  # revolutions per scan

    def __init__(self, name, front=0.0):
        super().__init__()
        self.name, self.front = name, front

    def merge(self, revolutions):
        if not (isinstance(revolutions, int) and revolutions >= 1):
            raise SourceError(f"revolutions must be a whole number above 0, not {revolutions!r}")
        self.merged = revolutions

    def __iter__(self):
        begin = last = None
        for revolutions in self._groups():
            time = float(revolutions[-1].times[-1])
            begin = time if begin is None else begin
            odometry = None
            if self.has_odometry:
                pose = self._pose_at(time)
                odometry = np.zeros(3) if last is None else between(last, pose)
                last = pose
            yield Reading(time - begin, odometry, self._scan(revolutions))

    def _revolutions(self):
        raise NotImplementedError

    def _pose_at(self, time):
        """Interpolate the odometry pose (3,) of the robot at a time [s]."""
        raise NotImplementedError

    def _scan(self, revolutions):
        """Deskew revolutions to the pose at their end; without odometry, only join them."""
        limits = self.sensor.range_max, self.sensor.range_min
        scans, ends = [revolution.scan(*limits, self.front) for revolution in revolutions], []
        if not self.has_odometry:
            times = np.concatenate([revolution.times for revolution in revolutions])
            return replace(concatenate_scans(scans), times=times - times[-1])
        for k, revolution in enumerate(revolutions):
            first, last = (self._pose_at(float(time)) for time in revolution.times[[0, -1]])
            scans[k] = deskew(scans[k], revolution.times, first, last)
            ends.append(last)
        return merge_scans(scans, ends)

    def _groups(self):
        group = []
        for revolution in self._revolutions():
            if not revolution.complete:
                self.damage["revolutions with a gap"] += 1
            if revolution.after_gap:
                self.damage["reconnections"] += 1
            group.append(revolution)
            if len(group) == self.merged:
                yield group
                group = []
        if group:
            yield group
