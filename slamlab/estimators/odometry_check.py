"""Odometry check by scan matching: finds disagreements and their possible causes.

Scans are matched without the odometry as a prior. The matched motions are then compared with the
odometry: the ratios of turns and distances, the direction, and the outliers.
"""

import numpy as np

from slamlab.estimators.base import Estimator
from slamlab.estimators.plausibility_check import impossible_shares
from slamlab.geometry import between, compose, wrap
from slamlab.scanmatching import match, preprocess

MIN_POINTS = 30  # least number of points of a compared scan
MIN_RANGE = 1.0  # least maximum range of a sensor whose scans are compared [m]
TURN, DISTANCE = 0.15, 0.25  # motion since the reference scan that starts a comparison [rad, m]
MAX_READINGS = 10  # so many readings start a comparison as well
MAX_PAIRS = 40  # of scans; with more, every second pair is removed and fewer are added
MIN_PAIRS = 8  # least number of pairs for any warning
MIN_LARGE = 4  # least number of pairs with a large motion for a warning about it
MIN_TURN, MIN_DISTANCE = 0.05, 0.1  # smaller motions give no reliable ratio [rad, m]
TOLERANCE = 0.25  # of the ratios from 1: wheels slip, and wheel bases are approximate [1]
MAX_OUTLIERS = 0.25  # largest share of outlier pairs while the ratios are correct [1]
OUTLIER = 0.15, 0.1  # least disagreement, in addition to the tolerance of the motion [m, rad]
UNITS = {1000.0: "in millimetres", 0.001: "in kilometres", 100.0: "in centimetres"}
REPEATED = 200.0  # larger ratios, if not of UNITS, mean that the scans do not change [1]
REMEDY = "; compare with --ignore-odometry"


class OdometryCheck(Estimator):
    """Dead reckoning that collects the motions ``odometry`` (k, 3) and ``matched`` (k, 3)."""

    def __init__(self, sensor):
        super().__init__()
        self.odometry, self.matched = [], []
        # scans of a sonar or of a short-range sensor cannot be matched without a prior
        self._comparable = not sensor.half_cone and sensor.range_max > MIN_RANGE
        self._reference, self._since, self._readings = None, np.zeros(3), 0
        self._every, self._due = 1, 0

    def step(self, reading):
        reading = self.usable(reading)
        self.pose = compose(self.pose, reading.odometry)
        self.record(reading.time)
        if self._comparable and self.has_odometry:
            self._take_in(reading)

    def _take_in(self, reading):
        self._since = compose(self._since, reading.odometry)
        self._readings += 1
        if reading.scan is None or np.count_nonzero(reading.scan.valid) < MIN_POINTS:
            return
        moved = np.hypot(*self._since[:2]) > DISTANCE or abs(self._since[2]) > TURN
        if self._reference is not None and not moved and self._readings < MAX_READINGS:
            return
        self._due -= 1
        # a reference is matched with the next scan only: distant scans may have no overlap
        if self._reference is not None:
            self._compare(preprocess(reading.scan.points()))
            self._reference = None
        if self._due <= 0:
            self._reference, self._due = preprocess(reading.scan.points()), self._every
        self._since, self._readings = np.zeros(3), 0

    def _compare(self, cloud):
        for guess, search in ((self._since, 0), (np.zeros(3), 0), (np.zeros(3), 1.0)):
            found = match(cloud, self._reference, guess, search=search)
            if found.good:
                break
        if not found.good or found.observability.degenerate.any():
            return
        self.odometry.append(self._since)
        self.matched.append(found.pose)
        if len(self.odometry) > MAX_PAIRS:
            del self.odometry[::2], self.matched[::2]
            self._every *= 2

    @property
    def warnings(self):
        """Sentences that state disagreements of odometry and scans, and their possible causes."""
        impossible = impossible_shares(self.counts, len(self._times))
        if impossible:
            return impossible
        odometry, matched = np.array(self.odometry), np.array(self.matched)
        if len(odometry) < MIN_PAIRS:
            return []
        scaled = [*_of_turns(odometry, matched), *_of_distances(odometry, matched)]
        return scaled or _of_outliers(odometry, matched)


def _of_turns(odometry, matched):
    given, seen = odometry[:, 2], matched[:, 2]
    large = (np.abs(given) > MIN_TURN) | (np.abs(seen) > MIN_TURN)
    if np.count_nonzero(large) < MIN_LARGE:
        return []
    ratio = _ratio(seen[large], given[large])
    begin = f"the odometry turns {_times(ratio)} as far as the scans do"
    if abs(ratio - 1) <= TOLERANCE:
        return []
    if abs(ratio + 1) <= 2 * TOLERANCE:
        return [
            "the odometry and the scans turn in opposite directions: the lidar may be mounted "
            "upside down (--upside-down), or the odometry's turns have the wrong sign "
            "(--turn-scale -1)"
        ]
    if abs(ratio) < TOLERANCE:
        return [f"{begin}: an encoder may be defective, or the wheels slip{REMEDY}"]
    if abs(ratio * np.pi / 180 - 1) <= TOLERANCE:
        return [f"{begin}: its turns may be in degrees (--turn-scale {np.pi / 180:.6f})"]
    if abs(ratio) > REPEATED:
        return [f"{begin}: the lidar or its driver may repeat an old scan"]
    return [
        f"{begin}: the field of view (--field-of-view) or the wheel base may be wrong "
        f"(--turn-scale {1 / ratio:.2f}), or the wheels slip"
    ]


def _of_distances(odometry, matched):
    given, seen = (np.hypot(*motions[:, :2].T) for motions in (odometry, matched))
    large = (given > MIN_DISTANCE) | (seen > MIN_DISTANCE)
    if np.count_nonzero(large) < MIN_LARGE:
        return []
    ratio = _ratio(seen[large], given[large])
    begin = f"the odometry moves {_times(ratio)} as far as the scans do"
    if abs(ratio - 1) <= TOLERANCE:
        return _of_directions(odometry[large], matched[large])
    if ratio < TOLERANCE:
        return [f"{begin}: an encoder may be defective, or the odometry is frozen{REMEDY}"]
    for factor, unit in UNITS.items():
        if abs(ratio / factor - 1) <= TOLERANCE:
            return [f"{begin}: it may be {unit} (--odometry-scale {1 / factor:g})"]
    if ratio > REPEATED:
        return [f"{begin}: the lidar or its driver may repeat an old scan"]
    return [
        f"{begin}: its unit or the wheel radius may be wrong (--odometry-scale {1 / ratio:.3g}), "
        "or the wheels slip"
    ]


def _of_directions(odometry, matched):
    """Return a warning if the mounting angle (yaw) of the lidar seems wrong."""
    off = np.arctan2(matched[:, 1], matched[:, 0]) - np.arctan2(odometry[:, 1], odometry[:, 0])
    off = wrap(off + (odometry[:, 2] - matched[:, 2]) / 2)
    mean = np.arctan2(np.sin(off).mean(), np.cos(off).mean())
    consistent = np.hypot(np.sin(off).mean(), np.cos(off).mean()) > 0.8
    if not consistent or abs(mean) < 3 * OUTLIER[1]:
        return []
    return [
        f"the scans move {abs(np.degrees(mean)):.0f}° to the {'left' if mean > 0 else 'right'} of "
        f"the odometry's direction: the lidar may be mounted at that angle "
        f"(--lidar-yaw {-np.degrees(mean):.0f})"
    ]


def _of_outliers(odometry, matched):
    off = between(odometry, matched)
    distance, turn = np.hypot(*matched[:, :2].T), np.abs(matched[:, 2])
    away = np.hypot(*off[:, :2].T) > OUTLIER[0] + TOLERANCE * distance
    turned = np.abs(off[:, 2]) > OUTLIER[1] + TOLERANCE * turn
    share = np.mean(away | turned)
    if share <= MAX_OUTLIERS:
        return []
    return [
        f"odometry and scans disagree in {100 * share:.0f} % of the compared motions: their "
        f"timestamps may differ, the wheels may slip, or the odometry may jump{REMEDY}"
    ]


def _ratio(seen, given):
    """Return the ratio of the odometry's motions to the matched motions (weighted median)."""
    weight = np.maximum(np.abs(seen), np.abs(given))
    if np.median(np.abs(seen)) < 0.1 * np.median(np.abs(given)):  # the scans hardly move
        return float(np.median(np.abs(given)) / max(np.median(np.abs(seen)), 1e-6))
    ratio = given / np.where(np.abs(seen) < 1e-6, 1e-6, seen)
    order = np.argsort(ratio)
    half = np.searchsorted(np.cumsum(weight[order]), weight.sum() / 2)
    return float(ratio[order][half])


def _times(ratio):
    return "hardly" if abs(ratio) < 0.01 else f"{ratio:.3g} times"
