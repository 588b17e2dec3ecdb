"""BreezySLAM log files: a robot with a Hokuyo URG-04LX lidar and wheel encoders, a scan a line.

Whole numbers apart by spaces: the stamp in µs, in columns 2 and 3 the ticks of the left and the
right wheel since the start, from column 24 on 682 ranges in mm, from right to left over 240°;
0 means that nothing came back.
"""

import numpy as np

from slamlab.files.errors import SourceError
from slamlab.geometry import compose, inverse
from slamlab.models.parameters import SensorModel
from slamlab.readings import Reading, Scan
from slamlab.simulation.differential_drive import arc
from slamlab.sources.log_file import LogFile

BEAMS, FIRST_RANGE_COLUMN = 682, 24  # number of ranges, column of the first
FIELD_OF_VIEW = np.radians(240)  # of the scan [rad]
RANGE_MIN, RANGE_MAX = 0.02, 5.6  # data sheet of the URG-04LX [m]
# the robot of these logs
WHEEL_RADIUS, WHEEL_BASE, TICKS_PER_TURN = 0.077, 0.33, 2000  # [m], [m], [1]
LIDAR_OFFSET = 0.145  # how far the lidar is ahead of the axle [m]


class BreezySlamLog(LogFile):
    """Log file in BreezySLAM's format as a source."""

    sensor = SensorModel(RANGE_MIN, RANGE_MAX, FIELD_OF_VIEW, range_error=0.01, range_sigma=0.01)

    def _parse(self, lines):
        rows = [row for line, _ in lines if (row := self._parse_line(line)) is not None]
        if not rows:
            raise SourceError(f"{self.name} holds no readable scan: is it a BreezySLAM log?")
        self._rows = np.array(rows)

    def __len__(self):
        return len(self._rows)

    def __iter__(self):
        angles = np.linspace(-FIELD_OF_VIEW / 2, FIELD_OF_VIEW / 2, BEAMS)
        before = self._rows[0]
        for row in self._rows:
            ranges = np.where(row[FIRST_RANGE_COLUMN:] > 0, row[FIRST_RANGE_COLUMN:] / 1000, np.nan)
            left, right = (row[2:4] - before[2:4]) * 2 * np.pi * WHEEL_RADIUS / TICKS_PER_TURN
            yield Reading(
                time=row[0] / 1e6,
                odometry=lidar_motion(arc(left, right, WHEEL_BASE)),
                scan=Scan(angles, ranges, RANGE_MAX, RANGE_MIN),
            )
            before = row

    def _parse_line(self, line):
        if not line.strip():
            return None
        try:
            row = np.array(line.split()[: FIRST_RANGE_COLUMN + BEAMS], dtype=float)
            if len(row) < FIRST_RANGE_COLUMN + BEAMS or not np.isfinite(row).all():
                raise ValueError
        except ValueError:
            self.damage["lines that hold no whole scan"] += 1
            self.skipped += 1
            return None
        return row


def is_breezyslam_line(first):
    """Recognise the format (BreezySLAM) by a file's first line: some 700 whole numbers.

    Parameters
    ----------
    first : bytes

    Returns
    -------
    bool
    """
    words, end = first.split(), FIRST_RANGE_COLUMN + BEAMS
    return len(words) >= end and all(word.isdigit() for word in words[FIRST_RANGE_COLUMN:end])


def lidar_motion(motion):
    """Odometry increment of the lidar (3,) [m, m, rad], in its own frame, from that of the axle."""
    ahead = np.array([LIDAR_OFFSET, 0, 0])
    return compose(compose(inverse(ahead), motion), ahead)
