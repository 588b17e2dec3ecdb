"""Wall following with a controller (MAK 7.3) that keeps a wall on the left and scans at stops.

This version corrects the published listing, which sets neither a forward speed nor ``target``, and
contains unmatched brackets.
"""

from dataclasses import dataclass

import numpy as np

from slamlab.geometry import compose

MARGIN = 1e-6  # of a step: rounding must not add another poll [m]


@dataclass(frozen=True)
class WallFollower:
    """Controller that keeps a wall on the left of the robot.

    Parameters
    ----------
    far, near : float, ranges above which the robot turns left, and below which it turns right [m]
    step : float, largest distance between two scans [m]
    look : float, direction of the scanner while driving, relative to the heading [rad]
    v, omega : float, speed and turn rate [m/s, rad/s]
    period : float, time between two measurements of the scanner [s]
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
            raise ValueError(f"near must be above 0 and below far ({self.near} and {self.far} m)")
        if not min(self.step, self.v, self.omega, self.period) > 0:
            raise ValueError("step, v, omega and period must be positive")

    def advance(self, simulator, read):
        """Move a Simulator to its next stop: turn until a wall is in range, then drive one step.

        ``read()`` returns the range in direction ``look`` [m]. Returns the odometry increment (3,)
        and the duration [s]. Raises ValueError if two rotations find no wall.
        """
        moved, polls = np.zeros(3), 0

        def go(v, omega):
            nonlocal moved, polls
            moved, polls = compose(moved, simulator.step(v, omega, self.period)), polls + 1
            if polls * self.omega * self.period > 4 * np.pi:
                raise ValueError(
                    f"no wall was found between {self.near} and {self.far} m in any direction"
                )

        while read() > self.far:
            go(0, self.omega)
        while read() < self.near:
            go(0, -self.omega)
        target = moved[:2]  # start of the step, named as in the listing
        while np.hypot(*(moved[:2] - target)) < self.step - MARGIN and read() > self.near:
            go(self.v, 0)
        return moved, polls * self.period
