"""The protocol every SLAM of the course follows: it takes readings in, one at a time."""

from collections import Counter

import numpy as np

from slamlab.estimators.stamps import odd_stamp
from slamlab.layers import Layer
from slamlab.readings import Reading, Trajectory


class Estimator:
    """Takes readings in and says where the robot is and what the map looks like.

    Subclasses implement ``step`` and ``layers`` and keep ``pose`` up to date. ``trajectory`` is the
    past as believed now: a graph revises it, a filter does not. ``status`` is one line for people,
    ``skipped`` counts readings with nothing usable in them, ``counts`` whatever else was odd.
    """

    status: str = ""

    def __init__(self):
        self.pose = np.zeros(3)
        self.skipped = 0
        self.counts = Counter()
        self._times: list[float] = []
        self._poses: list[np.ndarray] = []

    def step(self, reading: Reading) -> None:
        """Take one reading in.

        Parameters
        ----------
        reading : Reading
        """
        raise NotImplementedError

    def record(self, time):
        """Keep the present pose as that of ``time`` [s]; called at the end of ``step``."""
        odd = odd_stamp(self._times, time)
        if odd:
            self.counts[odd] += 1
        self._times.append(time)
        self._poses.append(np.array(self.pose, dtype=float))

    def told(self, *parts):
        """A status: what the estimator has to say, then what it counted."""
        return ", ".join([*parts, *(f"{n} {what}" for what, n in sorted(self.counts.items()))])

    def trajectory(self) -> Trajectory:
        """Every pose so far, as believed now.

        Returns
        -------
        Trajectory
        """
        return Trajectory(np.array(self._times), np.array(self._poses).reshape(-1, 3))

    def layers(self) -> list[Layer]:
        """What there is to draw.

        Returns
        -------
        list of layers of :mod:`slamlab.layers`
        """
        return []
