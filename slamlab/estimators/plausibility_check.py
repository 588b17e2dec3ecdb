"""Plausibility check of readings: removes impossible timestamps, odometry increments and scans
before they reach an estimator, and counts them."""

from dataclasses import replace

import numpy as np

from slamlab.readings import Scan

# largest plausible increment: constant, and per time
JUMP, MAX_SPEED = 0.5, 15.0  # of any robot [m, m/s]
SUDDEN_JUMP, SUDDEN_SPEED, SPEED_FACTOR = 0.2, 1.5, 2.0  # after slower motion [m, m/s, 1]
ACCELERATION = 1.0  # that adds to a sudden speed [m/s²]
MAX_TURN, MAX_TURN_RATE = 0.5, 8.0  # [rad, rad/s]
WINDOW = 20  # readings that determine the usual period and speed
GAP_FACTOR = 5.0  # a gap is longer than so many median periods [1]
MIN_PERIOD = 0.1  # least median period [s]
MAX_RANGE = 1000.0  # largest range of a lidar in the plane [m]
MAX_MEDIAN_RANGE = 200.0  # scans with a larger median range are in millimetres, or damaged [m]
MAX_SPAN = 6 * np.pi  # a larger span of angles is in degrees, or damaged [rad]
# at least MIN_EQUAL equal ranges beyond this share of the maximum range mean no return
OUTERMOST, MIN_EQUAL = 0.99, 4
ODOMETRY_JUMPS, NOT_FINITE = "odometry jumps", "odometry increments not finite"
TURN_JUMPS = "odometry jumps of the heading"
IN_MILLIMETRES = "scans whose ranges may be in millimetres"
IN_DEGREES = "scans whose angles may be in degrees"
MANY = 0.1  # a larger share of implausible readings has a common cause [1]
NO_BEAMS = Scan(np.empty(0), np.empty(0))


class PlausibilityCheck:
    """Removes implausible values from readings and counts them in ``counts``. ``period`` is the
    time between the last two readings [s]."""

    def __init__(self, counts):
        self.counts, self.period = counts, 0.0
        self._times, self._speeds = [], []

    def __call__(self, reading):
        """Check a reading: implausible odometry becomes None, scans become empty, ranges NaN."""
        reading = self._with_time(reading)
        if reading.odometry is not None:
            anomaly = self._odometry_anomaly(np.asarray(reading.odometry, dtype=float))
            if anomaly:
                self.counts[anomaly] += 1
                reading = replace(reading, odometry=None)
        if reading.scan is not None:
            scan, anomaly = checked_scan(reading.scan)
            if anomaly:
                self.counts[anomaly] += 1
            if scan is not reading.scan:
                reading = replace(reading, scan=scan)
        return reading

    def _with_time(self, reading):
        if not np.isfinite(reading.time):
            self.counts["timestamps not finite"] += 1
            reading = replace(reading, time=self._times[-1] if self._times else 0.0)
        anomaly = timestamp_anomaly(self._times, reading.time)
        if anomaly:
            self.counts[anomaly] += 1
        since = reading.time - self._times[-1] if self._times else 0.0
        self.period = since if since > 0 else usual_period(self._times)
        self._times = [*self._times[1 - WINDOW :], reading.time]
        return reading

    def _odometry_anomaly(self, odometry):
        """Return the anomaly of an increment (3,): not finite, too large, or ""."""
        if not np.isfinite(odometry).all():
            return NOT_FINITE
        distance, period = float(np.hypot(odometry[0], odometry[1])), self.period
        bound = JUMP + MAX_SPEED * period
        if len(self._speeds) == WINDOW:
            sudden = SPEED_FACTOR * max(self._speeds) + SUDDEN_SPEED + ACCELERATION * period
            bound = min(bound, SUDDEN_JUMP + sudden * period)
        # some logs have increments of half a second with timestamps milliseconds apart
        max_turn = MAX_TURN + MAX_TURN_RATE * max(period, MIN_PERIOD)
        if distance > bound:
            return ODOMETRY_JUMPS
        if abs(odometry[2]) > max_turn:
            return TURN_JUMPS
        self._speeds = [*self._speeds[1 - WINDOW :], distance / max(period, 1e-3)]
        return ""


def impossible_shares(counts, readings):
    """Return sentences that state frequent anomalies of the readings and their possible causes."""
    causes = (
        (ODOMETRY_JUMPS, "it may be in millimetres or centimetres (--odometry-scale 0.001, 0.01)"),
        (TURN_JUMPS, "its turns may be in degrees (--turn-scale 0.0174533)"),
        (NOT_FINITE, "the odometry may be damaged (--ignore-odometry)"),
        (IN_MILLIMETRES, "--range-scale 0.001 converts them"),
        (IN_DEGREES, "--field-of-view sets the angles"),
    )
    return [
        f"{counts[kind]} {kind} in {readings} readings: {cause}"
        for kind, cause in causes
        if counts[kind] > MANY * readings
    ]


def usual_period(times):
    """Return the median period of timestamps [s]; if there are too few timestamps, MIN_PERIOD."""
    if len(times) < 2:
        return MIN_PERIOD
    return max(float(np.median(np.abs(np.diff(times)))), MIN_PERIOD)


def timestamp_anomaly(times, time):
    """State in words that a timestamp [s] repeats, goes back or follows a gap; otherwise, ""."""
    if not times:
        return ""
    if time == times[-1]:
        return "timestamps repeated"
    if time < times[-1]:
        return "timestamps going back"
    if len(times) < 2:
        return ""
    since = time - max(times)
    if since <= GAP_FACTOR * MIN_PERIOD:  # nearly always; a median in each step would be slow
        return ""
    return "gaps" if since > GAP_FACTOR * usual_period(times) else ""


def checked_scan(scan):
    """Return the Scan without implausible ranges (no beams if unusable), and the anomaly."""
    angles, ranges = np.asarray(scan.angles), np.asarray(scan.ranges)
    if angles.shape != ranges.shape or angles.ndim != 1:
        return NO_BEAMS, "scans with different numbers of angles and ranges"
    if not len(ranges):
        return NO_BEAMS, "scans without beams"
    low, high = angles.min(), angles.max()
    if not (np.isfinite(low) and np.isfinite(high)) or (high == low and len(ranges) > 1):
        return NO_BEAMS, "scans without directions"
    if high - low > MAX_SPAN:
        return NO_BEAMS, IN_DEGREES
    valid = scan.valid
    hit = ranges[valid]
    if len(hit) and hit.max() > MAX_MEDIAN_RANGE and np.median(hit) > MAX_MEDIAN_RANGE:
        return NO_BEAMS, IN_MILLIMETRES
    wild = valid & ~((ranges > 0) & (ranges <= MAX_RANGE))
    anomaly = "scans with impossible ranges" if wild.any() else ""
    wild |= _no_returns(ranges, valid, scan.range_max)
    if not wild.any():
        return scan, ""
    return replace(scan, ranges=np.where(wild, np.nan, ranges)), anomaly


def _no_returns(ranges, valid, range_max):
    """Find ranges (n,) that mean no return: a repeated value near the maximum range."""
    near = valid & (ranges >= OUTERMOST * range_max)
    if np.count_nonzero(near) < MIN_EQUAL:
        return np.zeros(len(ranges), dtype=bool)
    values, counts = np.unique(ranges[near], return_counts=True)
    return near & np.isin(ranges, values[counts >= MIN_EQUAL])
