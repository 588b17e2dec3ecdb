"""BreezySLAM's logs: a mobile robot with a Hokuyo URG-04LX, one scan a line.

Whole numbers apart by spaces: the stamp in µs, in columns 2 and 3 the ticks of the left and the
right wheel since the start, from column 24 on 682 ranges in mm, from right to left over 240°;
0 means that nothing came back.
"""

import numpy as np

from slamlab.geometry import compose, inverse
from slamlab.hardware import SensorModel
from slamlab.readings import Reading, Scan
from slamlab.simulator import arc
from slamlab.sources.base import SourceError
from slamlab.sources.logfile import LogFile

BEAMS, FIRST = 682, 24
FIELD = np.radians(240)
RANGE_MIN, RANGE_MAX = 0.02, 5.6  # data sheet of the URG-04LX [m]
# the robot of these logs
WHEEL_RADIUS, AXLE, TICKS_PER_TURN = 0.077, 0.33, 2000  # [m], [m], [1]
LIDAR_AHEAD = 0.145  # of the axle [m]


class BreezySlamLog(LogFile):
    """A log in BreezySLAM's format."""

    sensor = SensorModel(RANGE_MIN, RANGE_MAX, FIELD, range_error=0.01, range_sigma=0.01)

    def _read(self, lines):
        rows = [row for line, _ in lines if (row := self._row(line)) is not None]
        if not rows:
            raise SourceError(f"{self.name} holds no readable scan: is it a BreezySLAM log?")
        self._rows = np.array(rows)

    def __len__(self):
        return len(self._rows)

    def __iter__(self):
        angles = np.linspace(-FIELD / 2, FIELD / 2, BEAMS)
        before = self._rows[0]
        for row in self._rows:
            ranges = np.where(row[FIRST:] > 0, row[FIRST:] / 1000, np.nan)
            left, right = (row[2:4] - before[2:4]) * 2 * np.pi * WHEEL_RADIUS / TICKS_PER_TURN
            yield Reading(
                time=row[0] / 1e6,
                odometry=seen_from_lidar(arc(left, right, AXLE)),
                scan=Scan(angles, ranges, RANGE_MAX, RANGE_MIN),
            )
            before = row

    def _row(self, line):
        if not line.strip():
            return None
        try:
            row = np.array(line.split()[: FIRST + BEAMS], dtype=float)
            if len(row) < FIRST + BEAMS or not np.isfinite(row).all():
                raise ValueError
        except ValueError:
            self.damage["lines that hold no whole scan"] += 1
            self.skipped += 1
            return None
        return row


def looks_like(first):
    """Whether a file's first line is one of such a log: some 700 whole numbers.

    Parameters
    ----------
    first : bytes

    Returns
    -------
    bool
    """
    words = first.split()
    return len(words) >= FIRST + BEAMS and all(w.isdigit() for w in words[FIRST : FIRST + BEAMS])


def seen_from_lidar(motion):
    """The lidar's motion (3,) [m, m, rad], in its own frame, when the axle makes that motion."""
    ahead = np.array([LIDAR_AHEAD, 0, 0])
    return compose(compose(inverse(ahead), motion), ahead)
