"""Base class of all estimators (SLAM algorithms): one reading a step, pose and map out."""

from collections import Counter

import numpy as np

from slamlab.estimators.odometry_jumps import odometry_anomaly, standing_still
from slamlab.estimators.timestamps import timestamp_anomaly
from slamlab.layers import Layer
from slamlab.readings import Reading, Trajectory


def counted(number, noun):
    """Say how many there are, for a status line: "1 landmark", "2 landmarks".

    Parameters
    ----------
    number : int
    noun : str, of one of them

    Returns
    -------
    str
    """
    return f"{number} {noun}{'' if number == 1 else 's'}"


class Estimator:
    """A SLAM algorithm: estimates the robot's pose and the map from readings, one at a time.

    Subclasses implement ``step`` and ``layers`` and keep ``pose`` up to date. ``trajectory`` is the
    past as believed now: a graph revises it, a filter does not. ``status`` is the status line,
    ``skipped`` counts readings with nothing usable in them, ``counts`` events and anomalies.
    ``warnings`` says, a sentence each, where the estimate rests on too little to be believed.
    """

    status: str = ""
    warnings: tuple[str, ...] | list[str] = ()

    def __init__(self):
        self.pose = np.zeros(3)
        self.skipped = 0
        self.counts = Counter()
        self._times: list[float] = []
        self._poses: list[np.ndarray] = []

    def step(self, reading: Reading) -> None:
        """Process one reading: predict by its odometry, correct by what it shows.

        Parameters
        ----------
        reading : Reading
        """
        raise NotImplementedError

    def usable(self, reading):
        """A reading whose odometry can be believed: of jumps there is none, and they are counted.

        The first call in ``step``.

        Parameters
        ----------
        reading : Reading

        Returns
        -------
        Reading
        """
        anomaly = odometry_anomaly(reading.odometry)
        if not anomaly:
            return reading
        self.counts[anomaly] += 1
        return standing_still(reading)

    def record(self, time):
        """Append the present pose to the trajectory, at ``time`` [s]; the last call in ``step``."""
        anomaly = timestamp_anomaly(self._times, time)
        if anomaly:
            self.counts[anomaly] += 1
        self._times.append(time)
        self._poses.append(np.array(self.pose, dtype=float))

    def status_line(self, *parts):
        """The status line: the given parts, then the counted events, then the warnings."""
        told = ", ".join([*parts, *(f"{n} {what}" for what, n in sorted(self.counts.items()))])
        return "; ".join([told, *(f"warning: {warning}" for warning in self.warnings)])

    def trajectory(self) -> Trajectory:
        """The estimated trajectory: every pose so far, as believed now.

        Returns
        -------
        Trajectory
        """
        return Trajectory(np.array(self._times), np.array(self._poses).reshape(-1, 3))

    def layers(self) -> list[Layer]:
        """The map and poses to draw, as layers.

        Returns
        -------
        list of layers of :mod:`slamlab.layers`
        """
        return []
