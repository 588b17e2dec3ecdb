"""Text that the RPLIDAR SDK's data grabber prints: one measured point a line.

``theta: DEGREES Dist: MILLIMETRES Q: QUALITY``, clockwise from the sensor's front; a turn begins
where theta jumps back; distance 0 means that nothing came back. There is no odometry and no time:
the sensor stands still and its turns are taken to follow one another at its usual rate.
"""

import re

import numpy as np

from slamlab.readings import Reading, Scan
from slamlab.sensors import RPLIDAR_A2
from slamlab.sources.base import SourceError
from slamlab.sources.logfile import LogFile

POINT = re.compile(rb"theta:\s*(\S+)\s+Dist:\s*(\S+)\s+Q:\s*(\d+)")
TURNS_PER_SECOND = 10.0
JUMP = 180.0  # theta falls by more than this where a turn begins [degrees]
WHOLE = 350.0  # what a turn spans [degrees]
FEWEST = 50  # points without which it is none


class GrabberLog(LogFile):
    """What the data grabber printed, as scans of a lidar that stands still."""

    sensor = RPLIDAR_A2.model

    def _read(self, lines):
        points = [p for line, _ in lines if (p := self._point(line)) is not None]
        theta, distance = np.array(points).reshape(-1, 2).T
        starts = np.flatnonzero(np.diff(theta) < -JUMP) + 1
        pieces = np.split(np.arange(len(theta)), starts)
        # the first and the last turn are seldom whole
        whole = [p for p in pieces if len(p) >= FEWEST and np.ptp(theta[p]) > WHOLE]
        if not whole:
            raise SourceError(f"{self.name} holds no whole turn of a lidar: has it been cut short?")
        self._turns = [(np.radians(-theta[piece]), distance[piece] / 1000) for piece in whole]

    def __len__(self):
        return len(self._turns)

    def __iter__(self):
        for turn, (angles, ranges) in enumerate(self._turns):
            scan = Scan(angles, ranges, self.sensor.range_max, self.sensor.range_min)
            yield Reading(time=turn / TURNS_PER_SECOND, scan=scan)

    def _point(self, line):
        """(theta [degrees], distance [mm]; NaN for none), or None where the line holds no point."""
        if b"theta" not in line:
            return None
        found = POINT.search(line)
        try:
            theta, distance = float(found[1]), float(found[2])
            if not (0 <= theta < 361 and 0 <= distance < 1e6):
                raise ValueError
        except (TypeError, ValueError):
            self.damage["lines without a readable point"] += 1
            return None
        return theta, distance if distance > 0 else np.nan
