"""RPLIDAR grabber text (SDK's ultra_simple data grabber): a log of one measured point a line.

``theta: DEGREES Dist: MILLIMETRES Q: QUALITY``, clockwise from the sensor's front; a turn begins
where theta jumps back; distance 0 means that nothing came back. There is no odometry and no time:
the sensor stands still and its turns are taken to follow one another at its usual rate.
"""

import re

import numpy as np

from slamlab.files.errors import SourceError
from slamlab.readings import Reading, Scan
from slamlab.simulation.range_scanners import RPLIDAR_A2
from slamlab.sources.log_file import LogFile

POINT_PATTERN = re.compile(rb"theta:\s*(\S+)\s+Dist:\s*(\S+)\s+Q:\s*(\d+)")  # regular expression
TURNS_PER_SECOND = 10.0  # scan rate that is assumed [Hz]
WRAP_JUMP = 180.0  # theta falls by more than this where a turn begins [degrees]
MIN_TURN_SPAN = 350.0  # least angle that a whole turn spans [degrees]
MIN_POINTS = 50  # of a turn


class GrabberLog(LogFile):
    """Log of the RPLIDAR grabber as a source: scans of a lidar that stands still."""

    sensor = RPLIDAR_A2.model

    def _parse(self, lines):
        points = [p for line, _ in lines if (p := self._parse_point(line)) is not None]
        theta, distance = np.array(points).reshape(-1, 2).T
        starts = np.flatnonzero(np.diff(theta) < -WRAP_JUMP) + 1
        pieces = np.split(np.arange(len(theta)), starts)
        # the first and the last turn are seldom whole
        whole = [p for p in pieces if len(p) >= MIN_POINTS and np.ptp(theta[p]) > MIN_TURN_SPAN]
        if not whole:
            raise SourceError(f"{self.name} holds no whole turn of a lidar: has it been cut short?")
        self._turns = [(np.radians(-theta[piece]), distance[piece] / 1000) for piece in whole]

    def __len__(self):
        return len(self._turns)

    def __iter__(self):
        for turn, (angles, ranges) in enumerate(self._turns):
            scan = Scan(angles, ranges, self.sensor.range_max, self.sensor.range_min)
            yield Reading(time=turn / TURNS_PER_SECOND, scan=scan)

    def _parse_point(self, line):
        """(theta [degrees], distance [mm]; NaN for none), or None where the line holds no point."""
        if b"theta" not in line:
            return None
        found = POINT_PATTERN.search(line)
        try:
            theta, distance = float(found[1]), float(found[2])
            if not (0 <= theta < 361 and 0 <= distance < 1e6):
                raise ValueError
        except (TypeError, ValueError):
            self.damage["lines without a readable point"] += 1
            return None
        return theta, distance if distance > 0 else np.nan
