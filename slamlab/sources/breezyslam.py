"""BreezySLAM log files: a robot with a Hokuyo URG-04LX lidar and wheel encoders, one scan per line.

Columns: 0: timestamp [µs]; 2 and 3: ticks of the left and right wheel; 24 to 705: ranges [mm] from
right to left, 0 for no return.
"""

import numpy as np

from slamlab.geometry import compose, inverse
from slamlab.models.parameters import SensorModel
from slamlab.readings import Reading, Scan
from slamlab.simulation.differential_drive import arc
from slamlab.sources.base import LogFile

BEAMS, FIRST_RANGE_COLUMN = 682, 24  # number of ranges, column of the first
COLUMNS = FIRST_RANGE_COLUMN + BEAMS  # required; others may follow
FIELD_OF_VIEW = np.radians(240)  # of the scan [rad]
RANGE_MIN, RANGE_MAX = 0.02, 5.6  # data sheet of the URG-04LX [m]
# the robot of these logs
WHEEL_RADIUS, WHEEL_BASE, TICKS_PER_TURN = 0.077, 0.33, 2000  # [m], [m], [1]
LIDAR_OFFSET = 0.145  # of the lidar ahead of the wheel axle [m]


class BreezySlamLog(LogFile):
    kind = "a BreezySLAM log"
    sensor = SensorModel(RANGE_MIN, RANGE_MAX, FIELD_OF_VIEW, range_error=0.01, range_sigma=0.01)

    @staticmethod
    def recognises(head):
        rows = [line.split() for line in head.splitlines()[:3]]  # some may be damaged
        return any(len(row) >= COLUMNS and b"".join(_scan(row)).isdigit() for row in rows)

    def _parse(self, file):
        first, moved = None, False
        for number, line, complete in file.lines():
            words = line.split()
            try:
                # the last number of a truncated line may be incomplete
                if len(words) < COLUMNS or (len(words) == COLUMNS and not complete):
                    raise ValueError
                stamp, *ticks = (float(words[column]) for column in (0, 2, 3))
                ranges = np.fromiter(map(float, _scan(words)), float, BEAMS)
                if not (np.isfinite([stamp, *ticks]).all() and np.isfinite(ranges).all()):
                    raise ValueError
            except ValueError:
                if words:
                    self._count_lost("lines without a complete scan", number)
                continue
            first = first or ticks
            moved = moved or ticks != first
            self._rows.append((stamp, np.array(ticks), ranges))
        if not len(self._rows):
            raise self._nothing_usable("readable scan of a BreezySLAM log")
        self.has_odometry = moved or len(self._rows) == 1
        if not self.has_odometry:
            self.notes.append("the ticks of the wheels never change, so they are ignored")

    def __iter__(self):
        angles = np.linspace(-FIELD_OF_VIEW / 2, FIELD_OF_VIEW / 2, BEAMS)
        before = None
        for stamp, ticks, ranges in self._rows:
            before = ticks if before is None else before
            left, right = (ticks - before) * 2 * np.pi * WHEEL_RADIUS / TICKS_PER_TURN
            odometry = lidar_motion(arc(left, right, WHEEL_BASE))
            ranges = np.where(ranges > 0, ranges / 1000, np.nan)
            yield Reading(
                time=stamp / 1e6,
                odometry=odometry if self.has_odometry else None,
                scan=Scan(angles, ranges, RANGE_MAX, RANGE_MIN),
            )
            before = ticks


def lidar_motion(motion):
    """Convert the axle's odometry increment (3,) to the lidar's increment in the lidar's frame."""
    ahead = np.array([LIDAR_OFFSET, 0, 0])
    return compose(compose(inverse(ahead), motion), ahead)


def _scan(words):
    """Return the words of a line that contain the ranges of a scan."""
    return words[FIRST_RANGE_COLUMN:COLUMNS]
