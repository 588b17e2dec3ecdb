"""Wall-following controller (MAK thesis 7.3): keep to the wall on the left, a scan at every stop.

The listing, mended: it never sets a forward speed nor ``target``, the place a drive starts from, so
its robot would stand still for ever; its brackets do not pair; and its comment "more than 4 cm"
stands over a loop that drives 4 cm at most.
"""

from dataclasses import dataclass

import numpy as np

from slamlab.geometry import compose

MARGIN = 1e-6  # of a step, which is a whole number of polls: rounding must not add another [m]


@dataclass(frozen=True)
class WallFollower:
    """Rules of wall following: how the robot goes along a wall on its left.

    Parameters
    ----------
    far : float, a longer reading of the wall ahead on the left: turn left [m]
    near : float, a shorter one: turn right [m]
    step : float, farthest drive from one scan to the next [m]
    look : float, where the scanner points while driving, from the heading [rad]
    v, omega : float, speeds [m/s, rad/s]
    period : float, from one reading of the scanner to the next [s]
    """

    far: float = 0.25
    near: float = 0.18
    step: float = 0.04
    look: float = np.radians(45)
    v: float = 0.1
    omega: float = 1.0
    period: float = 0.1

    def __post_init__(self):
        if not 0 < self.near < self.far:
            raise ValueError(f"near and far are 0 < near < far, not {self.near} and {self.far} m")
        if not min(self.step, self.v, self.omega, self.period) > 0:
            raise ValueError("step, v, omega and period are above zero")

    def advance(self, simulator, read):
        """Control from one scan to the next: turn until the wall is in reach, then drive a little.

        Parameters
        ----------
        simulator : Simulator, moved
        read : callable() -> float, the scanner's range in direction ``look``; inf without an echo

        Returns
        -------
        odometry : (3,) increment by the encoders, in the frame of the pose before
        seconds : float, how long it took [s]

        Raises
        ------
        ValueError : the robot turned twice round and found no wall to go along
        """
        moved, polls = np.zeros(3), 0

        def go(v, omega):
            nonlocal moved, polls
            moved, polls = compose(moved, simulator.step(v, omega, self.period)), polls + 1
            if polls * self.omega * self.period > 4 * np.pi:
                raise ValueError(f"no wall between {self.near} and {self.far} m on any side")

        while read() > self.far:
            go(0, self.omega)
        while read() < self.near:
            go(0, -self.omega)
        target = moved[:2]  # the listing's name for where the drive starts
        while np.hypot(*(moved[:2] - target)) < self.step - MARGIN and read() > self.near:
            go(self.v, 0)
        return moved, polls * self.period
