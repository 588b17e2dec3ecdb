"""Base class of all estimators."""

from collections import Counter
from dataclasses import replace

import numpy as np

from slamlab.estimators.plausibility_check import PlausibilityCheck
from slamlab.geometry import between
from slamlab.layers import Layer
from slamlab.readings import Reading, Trajectory

MAX_EXTRAPOLATION = 3.0  # longest extrapolation by constant velocity, in periods [1]


def counted(number, noun):
    """Return a number and a noun in the right form: "1 landmark", "2 landmarks"."""
    return f"{number} {noun}{'' if number == 1 else 's'}"


class Estimator:
    """A SLAM algorithm: estimates pose and map from readings, one at a time.

    Subclasses implement ``step`` and ``layers`` and keep ``pose`` (3,) [m, m, rad]. ``status`` is
    the status line. ``skipped`` counts unusable readings, and ``counts`` counts events and
    anomalies. ``warnings`` lists sentences that state why the estimate may be wrong.
    """

    status: str = ""
    warnings: tuple[str, ...] | list[str] = ()
    laser_odometry = None  # the LaserOdometry of an estimator that matches scans

    def __init__(self):
        self.counts = Counter()
        self.plausibility, self._has_odometry = PlausibilityCheck(self.counts), None
        self.pose = np.zeros(3)
        self.skipped = 0
        self._times: list[float] = []
        self._poses: list[np.ndarray] = []

    def step(self, reading: Reading) -> None:
        """Process one Reading: predict by odometry, correct by observations."""
        raise NotImplementedError

    def usable(self, reading):
        """Check the reading and complete its odometry; ``step`` must call this first.

        If no reading has had odometry so far, an estimator that matches scans uses laser odometry.
        Constant velocity replaces a missing or implausible increment.
        """
        self._has_odometry = bool(self._has_odometry or reading.odometry is not None)
        reading = self.plausibility(reading)
        if reading.odometry is not None:
            return reading
        if self.without_odometry:
            return self.laser_odometry(reading, self.plausibility.period)
        return replace(reading, odometry=self._constant_velocity_motion())

    @property
    def has_odometry(self):
        """Whether any reading so far had odometry."""
        return bool(self._has_odometry)

    @property
    def without_odometry(self):
        """Whether the motion is estimated from scans alone."""
        return self.laser_odometry is not None and self._has_odometry is False

    def _constant_velocity_motion(self):
        """Return the motion (3,) since the last reading; constant velocity extrapolates it."""
        if len(self._poses) < 2:
            return np.zeros(3)
        before = self._times[-1] - self._times[-2]
        share = self.plausibility.period / before if before > 0 else 0.0
        return min(share, MAX_EXTRAPOLATION) * between(*self._poses[-2:])

    def record(self, time):
        """Append the pose at ``time`` [s] to the trajectory; ``step`` must call this last."""
        self._times.append(time)
        self._poses.append(np.array(self.pose, dtype=float))

    def status_line(self, *parts):
        """Return a status line that contains the given parts, event counts and warnings."""
        status = ", ".join([*parts, *(f"{n} {what}" for what, n in sorted(self.counts.items()))])
        return "; ".join([status, *(f"warning: {warning}" for warning in self.warnings)])

    def trajectory(self) -> Trajectory:
        """Return the present estimate of the trajectory; a pose graph also revises past poses."""
        return Trajectory(np.array(self._times), np.array(self._poses).reshape(-1, 3))

    def shown(self, layers):
        """Return the layers; without odometry, the naive map's layers are left out."""
        return [each for each in layers if not (self.without_odometry and each.name == "naive")]

    def layers(self) -> list[Layer]:
        """Return the map and the poses to draw; see :mod:`slamlab.layers`."""
        return []
