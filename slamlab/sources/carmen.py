"""CARMEN log files: the format of the classic public data sets (Intel Lab), one message a line.

A scan is ``FLASER n r_1 … r_n x y θ odom_x odom_y odom_θ stamp host logger_stamp``: ranges in
metres from right to left, the laser's pose (here ignored: a corrected log holds somebody's result
there), the odometry's pose, the time of the scan. Other messages and comments are passed over.
"""

import numpy as np

from slamlab.files.errors import SourceError
from slamlab.geometry import between
from slamlab.models.parameters import SensorModel
from slamlab.readings import Reading, Scan
from slamlab.sources.log_file import LogFile

RANGE_MAX = 80.0  # [m]; a SICK LMS reports 81.83 or 81.91 m where nothing came back
MAX_ODOMETRY = 1e7  # no robot's odometry is beyond this [m]
SATURATION_BAND = 0.995  # share of the greatest range from which ranges are no returns [1]
MIN_SATURATED, SATURATION_RATIO = 20, 5.0  # at least so many, and so many times those below [1]
SATURATION_DISTANCE = 3.0  # times the median of the others, or it is a wall [1]
ANGLE_INCREMENTS = {180: 1.0, 181: 1.0, 360: 0.5, 361: 0.5, 400: 0.25, 401: 0.25}
"""Angle increment from beam to beam, by number of beams [degree]."""


class CarmenLog(LogFile):
    """CARMEN log as a source of scans and odometry increments, plain or gzip."""

    def _parse(self, lines):
        self._range_max = RANGE_MAX
        self._rows = []
        for line, complete in lines:
            self._parse_line(line, complete)
        if not self._rows:
            lost = f" ({self.skipped} were unreadable)" if self.skipped else ""
            raise SourceError(
                f"{self.name} holds no readable FLASER line{lost}: is it a CARMEN log?"
            )
        backwards = np.diff([stamp for stamp, _, _ in self._rows]) < 0
        if backwards.any():
            self.damage["stamps that run backwards"] += int(backwards.sum())
        self._range_max = saturation([row[2] for row in self._rows], self._range_max)
        self.sensor = SensorModel(
            range_max=self._range_max, field_of_view=np.pi, range_sigma=0.01, range_error=0.0
        )

    def __len__(self):
        return len(self._rows)

    def __iter__(self):
        before = None
        for stamp, odometry, ranges in self._rows:
            yield Reading(
                time=stamp,
                odometry=np.zeros(3) if before is None else between(before, odometry),
                scan=Scan(beam_angles(len(ranges)), ranges, range_max=self._range_max),
            )
            before = odometry

    def _parse_line(self, line, complete):
        """Parse a line: keep a scan, note a setting, count damage, ignore everything else."""
        words = line.split()
        if words[:2] == [b"PARAM", b"robot_front_laser_max"] and len(words) > 2:
            limit = float_or_none(words[2])
            if limit is not None and 0 < limit < np.inf:
                self._range_max = limit
        if words[:1] != [b"FLASER"]:
            return
        try:
            row = parse_flaser(words, complete)
        except ValueError as kind:
            self.damage[str(kind)] += 1
            self.skipped += 1
            return
        unusable = ~(row[2] >= 0) | np.isinf(row[2])
        if unusable.any():
            self.damage["ranges NaN, infinite or negative"] += int(unusable.sum())
            row[2][unusable] = np.nan
        self._rows.append(row)


def saturation(scans, range_max):
    """The range a scanner reports where nothing came back, where the log shows one.

    Scanners set otherwise than Intel's report 50, 51.15 or 32.76 m and no setting says so. Taken
    for walls they go along with the robot. They are told by their number at the end of the range.

    Parameters
    ----------
    scans : list of (n,) ranges [m]
    range_max : float, from which a range is no return in any case [m]

    Returns
    -------
    float, range_max or less [m]
    """
    ranges = np.concatenate(scans)
    ranges = ranges[ranges < range_max]
    if len(ranges) == 0:
        return range_max
    top = ranges.max()
    limit = SATURATION_BAND * top
    rest = ranges[ranges < limit]
    if len(rest) == 0 or top < SATURATION_DISTANCE * np.median(rest):
        return range_max
    saturated, below = len(ranges) - len(rest), np.count_nonzero(rest >= 0.9 * top)
    return limit if saturated > max(MIN_SATURATED, SATURATION_RATIO * below) else range_max


def parse_flaser(words, complete):
    """Parse a FLASER message (laser scan): time stamp [s], odometry (3,) and ranges (n,) [m].

    Raises
    ------
    ValueError : its text is the kind of damage
    """
    count = words[1] if len(words) > 1 else b""
    if not count.isdigit():
        raise ValueError("lines without a count of ranges" if complete else "lines cut short")
    # six numbers of poses and the stamp must follow, host and logger's stamp may
    surplus = len(words) - 2 - int(count) - 7
    if not complete and surplus < 1:
        raise ValueError("lines cut short")
    if not 0 <= surplus <= 2:
        raise ValueError("lines whose count of ranges is wrong")
    numbers = [float_or_none(word) for word in words[2 : len(words) - surplus]]
    if None in numbers:
        raise ValueError("lines with a word where a number belongs")
    values = np.array(numbers, dtype=float)
    ranges, odometry, stamp = values[: int(count)], values[-4:-1], values[-1]
    if not np.isfinite(values[-4:]).all() or np.abs(odometry).max() > MAX_ODOMETRY:
        raise ValueError("lines without a finite odometry and stamp")
    return float(stamp), odometry, ranges


def float_or_none(word):
    """Number that a word stands for (float), or None."""
    try:
        return float(word)
    except ValueError:
        return None


def beam_angles(count):
    """Beam angles (bearings) of a scan, as CARMEN takes them from the number of beams.

    The first looks to the right (−90°). 181, 361 and 401 beams are a SICK's 1°, 0.5° and 0.25°; one
    less is the same without the last beam. A 0.25° scan covers 100°, centred. Other numbers are
    spread over 180°.

    Parameters
    ----------
    count : int

    Returns
    -------
    (count,) [rad]
    """
    step = ANGLE_INCREMENTS.get(count, 180.0 / max(1, count - 1))
    first = -50.0 if count in (400, 401) else -90.0
    return np.radians(first + step * np.arange(count))
