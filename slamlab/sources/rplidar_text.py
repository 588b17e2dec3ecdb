"""RPLIDAR text logs: scans of a lidar without a robot, as a sequence of measured points.

Angles run clockwise from the front, as in the device; a distance of 0 means no return.
"""

from array import array
from collections import Counter
from dataclasses import replace
from itertools import islice

import numpy as np

from slamlab.files import SourceError
from slamlab.readings import Reading, Scan
from slamlab.simulation.range_scanners import RPLIDAR_A2
from slamlab.sources.base import LogFile
from slamlab.sources.log_units import time_unit
from slamlab.sources.rplidar_text_formats import SAMPLE, KeyValueFormat, TableFormat, UnreadableLine

DEFAULT_PERIOD = 0.1  # of a revolution, for a log without times [s]
PERIODS = 0.02, 2.0  # plausible periods of a revolution [s]
WRAP_JUMP = 180.0  # larger jumps of the angle begin a revolution [degree]
MAX_SWEEP, MAX_POINTS = 363.0, 50_000  # of a revolution without a start flag [degree, 1]
MIN_SPAN, MIN_POINTS, MIN_SHARE = 350.0, 50, 0.7  # of a complete revolution [degree, 1, of median]
RANGES_MAX = 12.0, 25.0, 40.0  # of the models, from A1 to S3 [m]
MAX_BEYOND = 0.02  # share of points beyond a model's range [1]
MAX_RANGE = 1000.0  # of a valid distance [m]
METRES = {"m": 1.0, "cm": 0.01, "mm": 0.001}
DEGREES = {"degree": 1.0, "radian": float(np.degrees(1.0))}
HEADER = "insert the first line angle_deg,distance_mm (or angle_rad,distance_m)"
UNREADABLE = "lines without a readable point"


class RplidarText(LogFile):
    """Scans of a lidar without odometry; a reading's time is the end of its revolution."""

    kind, has_odometry = "RPLIDAR text (points with angle and distance)", False

    @staticmethod
    def recognises(head):
        return KeyValueFormat.recognises(head) or TableFormat.recognises(head)

    def _parse(self, file):
        head = file.head()
        self._dialect = (KeyValueFormat if KeyValueFormat.recognises(head) else TableFormat)(head)
        lines = enumerate(head.splitlines()[:-1] or [head], 1)
        points = self._points((number, line, True) for number, line in lines)
        sample = [p for p in islice(points, SAMPLE) if np.isfinite(p[1:3]).all()]
        if not sample:
            raise SourceError(
                f"{self.name} contains no point with angle and distance. To name them, {HEADER}"
            )
        self._find_units(np.array(sample))
        lengths = [len(turn) for turn in self._revolutions(self._valid(sample))]
        self._usual = float(np.median(lengths[1:-1] or lengths or [1]))
        self.damage.clear()
        self._ends, held, number = array("d"), None, 0
        for number, turn in enumerate(self._revolutions(self._valid(self._points(file.lines())))):
            added = held is None or self._add(number - 1, held, inner=number > 1)
            if not added and number > 1:
                self._count_lost("incomplete revolutions", self._number)
            held = np.array(turn)
        if held is not None:  # the last revolution, like the first, is seldom complete
            self._add(number, held, inner=False)
        self.skipped += round(self.damage[UNREADABLE] / self._usual)
        self.damage += Counter()  # removes zeros
        if not len(self._rows):
            raise self._nothing_usable("complete revolution of a lidar; the file may be truncated")
        self._find_period()
        self._dialect = None

    def __iter__(self):
        limits = self.sensor.range_max, self.sensor.range_min
        for number, end, angles, ranges, since_end in self._rows:
            time = number * DEFAULT_PERIOD if self._unit is None else end * self._unit
            times = since_end * (self._period if self._unit is None else self._unit)
            yield Reading(time, scan=Scan(angles, ranges, *limits, times))

    def _points(self, lines):
        """Yield the points (mark, angle, distance, time) of lines in the file's units."""
        for self._number, line, _ in lines:
            try:
                yield from self._dialect.points(line)
            except UnreadableLine:
                self.damage[UNREADABLE] += 1

    def _valid(self, points):
        """Yield the valid points in degrees and metres."""
        for mark, angle, distance, time in points:
            angle, distance = angle * self._degrees, distance * self._metres
            if 0 <= angle < 361 and 0 <= distance < MAX_RANGE:
                yield mark, angle, distance, time
            else:
                self.damage[UNREADABLE] += 1

    def _revolutions(self, points):
        """Yield a list of the points of each revolution."""
        turn, sweep, last = [], 0.0, None
        for point in points:
            step = 0.0 if last is None else point[1] - last
            last = point[1]
            sweep += (step + 180.0) % 360.0 - 180.0
            wraps = self._dialect.wraps and abs(step) > WRAP_JUMP
            if self._dialect.marks:
                wraps = point[0] or (self._dialect.wraps and abs(sweep) > MAX_SWEEP)
            if turn and (wraps or len(turn) == MAX_POINTS):
                yield turn
                turn, sweep = [], 0.0
            turn.append(point)
        if turn:
            yield turn

    def _add(self, number, turn, inner):
        """Add a revolution (n, 4) if complete; return success. ``inner``: not the first or last."""
        marks, angles, ranges, times = turn.T
        usual = (inner or self._dialect.bounded) and len(turn) > MIN_SHARE * self._usual
        if len(turn) < MIN_POINTS or not (usual or np.ptp(angles) > MIN_SPAN):
            return False
        # rotation of the lidar at each point, from the beginning to the end of the revolution
        begin = angles[marks > 0][:1] if self._dialect.by_angle and marks.any() else angles[:1]
        since_end = (angles - begin) % 360.0 / 360.0 - 1.0
        if np.all(np.diff(times) > 0):
            since_end = times - times[-1]
        self._ends.append(times[-1])
        ranges = np.where(ranges > 0, ranges, np.nan)
        self._rows.append((number, times[-1], np.radians(-angles), ranges, since_end))
        return True

    def _find_units(self, sample):
        """Find the units of angle and distance from the header or from a sample (n, 4)."""
        _, angles, distances, _ = sample.T
        if np.mean(angles < 0) > 0.01:
            raise SourceError(
                f"{self.name}: the angles begin at {np.nanmin(angles):g}, so their direction is "
                "unknown. Convert them to angles from 0, clockwise from the front"
            )
        given, top = self._dialect.units, float(np.nanquantile(angles, 0.99))
        angle = "degree" if top > 6.4 else "radian" if top > 5.5 else "none"
        middle = float(np.nanmedian(distances[distances > 0])) if np.any(distances > 0) else np.nan
        distance = "mm" if middle > 100 else "m" if middle < 60 else "none"
        for what, by_numbers, value in (("angle", angle, top), ("distance", distance, middle)):
            if given[what] is None and by_numbers == "none":
                number = f"the unit of the {what} {value:g} is ambiguous"
                raise SourceError(f"{self.name}: {number}. To set it, {HEADER}")
            if given[what] not in (None, by_numbers, "cm") and by_numbers != "none":
                raise SourceError(
                    f"{self.name}: the unit of the {what} is {given[what]} in the text, but its "
                    f"values (such as {value:g}) suggest {by_numbers}. Correct the text"
                )
        self._degrees = DEGREES[given["angle"] or angle]
        self._metres = METRES[given["distance"] or distance]
        ranges = distances * self._metres
        fitting = [limit for limit in RANGES_MAX if np.mean(ranges > limit) < MAX_BEYOND]
        limit = fitting[0] if fitting else RANGES_MAX[-1]
        self.sensor = replace(RPLIDAR_A2.model, range_max=limit)

    def _find_period(self):
        """Find the unit of increasing times [s] and the period of a revolution."""
        self._unit, self._period = None, DEFAULT_PERIOD
        periods = np.diff(self._ends)
        if len(periods) and np.isfinite(periods).all() and (periods > 0).all():
            self._unit = time_unit(self._ends, *PERIODS)
            if self._unit is not None:
                self._period = float(np.median(periods)) * self._unit
