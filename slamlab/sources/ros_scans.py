"""Scans from ROS messages (LaserScan): checks of fields and units, duration of the sweep."""

from collections import Counter
from typing import NamedTuple

import numpy as np

from slamlab.readings import Scan

MAX_OFF = 2.5  # error of angle_max; drivers differ by one beam [beams]
MAX_SPAN = 2 * np.pi + 0.1  # of the angles; larger ones are in degrees [rad]
MAX_NEAREST = 100.0  # lowest decile of the ranges; beyond it they are in millimetres [m]
NO_RANGE = 1e5  # larger values mean no return, also in millimetres [m]
MIN_RANGES = 10  # for a check of the units
SWEEP_TOLERANCE = 0.1  # of a sweep's duration by time_increment, relative to scan_time [1]

CHECK_LIDAR = "check whether the lidar turns and its driver publishes"
SET_HEADER = "correct it in the driver, or in a copy of the bag"


class RosScan(NamedTuple):
    """Fields of a LaserScan in compact form; ``duration`` of the sweep [s], 0 if unknown.

    ranges : (n,) float32, NaN: no return [m].
    """

    first_angle: float
    increment: float
    ranges: np.ndarray
    range_min: float
    range_max: float
    duration: float

    def scan(self, upside_down=False):
        """Return the Scan in the laser's frame, viewed from above."""
        angles = self.first_angle + self.increment * np.arange(len(self.ranges))
        return Scan(
            -angles if upside_down else angles,
            self.ranges.astype(float),
            self.range_max,
            self.range_min,
        )


class Unusable(ValueError):
    """A message has no usable scan; the error has a ``kind``, a sentence and a remedy."""

    def __init__(self, kind, sentence, remedy=SET_HEADER):
        super().__init__(f"{sentence}; {remedy}")
        self.kind = kind


class ScanReader:
    """Reader of scans from the messages of a topic; ``refused`` counts invalid scans by kind."""

    def __init__(self):
        self.returns = 0
        self.refused, self.examples = Counter(), {}
        self.odd_times = 0

    def __call__(self, message):
        """Read a RosScan; return None if it is invalid."""
        try:
            return self._read(message)
        except Unusable as why:
            self.refused[why.kind] += 1
            self.examples.setdefault(why.kind, str(why))
            return None

    def usual_refusal(self):
        """Return the error message of one scan with the most frequent kind of fault."""
        return self.examples[self.refused.most_common(1)[0][0]]

    def _read(self, message):
        ranges = _first_echoes(message.ranges)
        low, step = float(message.angle_min), float(message.angle_increment)
        _check_angles(low, step, float(message.angle_max), len(ranges))
        nearest, farthest = float(message.range_min), float(message.range_max)
        if farthest > 0 and nearest >= farthest:
            sentence = f"range_min, {nearest:g}, is not below range_max, {farthest:g}"
            raise Unusable("scans whose range_min is not below range_max", sentence)
        _check_units(ranges, farthest)
        with np.errstate(invalid="ignore"):
            ranges[~(np.isfinite(ranges) & (ranges > 0))] = np.nan
        nearest = nearest if 0 < nearest < np.inf else 0.0
        farthest = farthest if farthest > 0 else np.inf
        duration = _duration(message, len(ranges), abs(step) * len(ranges))
        if duration is None:
            self.odd_times += 1
        scan = RosScan(low, step, ranges, nearest, farthest, duration or 0.0)
        self.returns += int(np.count_nonzero((ranges > nearest) & (ranges < farthest)))
        return scan


def _first_echoes(ranges):
    """Return ranges (n,) float32 [m] of a LaserScan, or first echoes of a MultiEchoLaserScan."""
    if len(ranges) and hasattr(ranges[0], "echoes"):
        ranges = [beam.echoes[0] if len(beam.echoes) else np.nan for beam in ranges]
    return np.array(ranges, dtype=np.float32)


def _check_angles(low, step, high, count):
    """Check the angles of a header and the number of beams [rad]. Raises Unusable."""
    if count == 0:
        raise Unusable("scans without beams", "ranges is empty", CHECK_LIDAR)
    if not np.isfinite([low, step, high]).all():
        sentence = f"angle_min, angle_increment and angle_max are {low:g}, {step:g} and {high:g}"
        raise Unusable("scans with angles that are not finite", sentence)
    if count == 1:
        return
    if step == 0:
        sentence = f"angle_increment is 0 with {count} ranges from {low:g} to {high:g} rad"
        raise Unusable("scans with an angle_increment of 0", sentence)
    if max(abs(step) * (count - 1), abs(high - low)) > MAX_SPAN:
        sentence = f"the angles span {high - low:g} (angle_min {low:g}, angle_max {high:g}, "
        sentence += f"angle_increment {step:g}, {count} ranges), more than 2π rad"
        remedy = f"if they are in degrees, convert them to radians: {SET_HEADER}"
        raise Unusable("scans whose angles span more than 2π rad", sentence, remedy)
    last = low + step * (count - 1)
    if abs(high - last) > MAX_OFF * abs(step):
        sentence = f"angle_max, {high:g}, is not angle_min + angle_increment × (n − 1) = "
        sentence += f"{low:g} + {step:g} × {count - 1} = {last:g}"
        raise Unusable("scans whose angle_max contradicts the other angles", sentence)


def _check_units(ranges, range_max):
    """Check that the unit of ranges is metres. Raises Unusable for millimetres."""
    values = ranges[(ranges > 0) & (ranges < NO_RANGE)]
    if len(values) < MIN_RANGES:
        return
    values = values[values < values.max()]  # the maximum may mean no return
    if len(values) >= MIN_RANGES and np.quantile(values, 0.1) > MAX_NEAREST:
        sentence = f"ranges has a median of {np.median(values):g} (range_max {range_max:g})"
        remedy = f"if they are in millimetres, convert them to metres: {SET_HEADER}"
        raise Unusable("scans whose ranges may be in millimetres", sentence, remedy)


def _duration(message, count, span):
    """Return the duration of a sweep [s], 0 if not given, None if the header is inconsistent.

    Some drivers divide ``scan_time`` by the number of beams; others scan only part of the circle.
    """
    duration = abs(float(message.time_increment)) * (count - 1)  # direction: see ros_beam_order
    if duration == 0 or count < 2:
        return 0.0
    revolution = float(message.scan_time)
    for expected in (revolution, revolution * span / (2 * np.pi)):
        if expected > 0 and abs(duration - expected) <= SWEEP_TOLERANCE * expected:
            return duration
    return None
