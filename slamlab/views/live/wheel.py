"""The wheel of a live view: a robot driven by named commands, or along a way that was typed."""

from contextlib import suppress
from math import remainder, tau

import numpy as np

from slamlab.views.live.commands import understood

EAGER = 1.5  # speed towards a goal for each metre that is left [1/s]
SLOWEST = 0.1  # share of the top speed with which a goal is reached
NEAR = 0.01, np.radians(1)  # a goal counts as reached within this [m, rad]
STAND = 0.0, 0.0


class Wheel:
    """Gives the robot of a loop its commands.

    A simulated robot that has played its part moves by the command of each step; a real one is told
    once, and drives on by itself.

    Parameters
    ----------
    loop : Loop
    """

    def __init__(self, loop):
        self._loop, self._way = loop, None

    @property
    def _own_clock(self):
        """bool, whether the robot drives on by itself."""
        pair = self._loop.pair
        return pair.drivable and pair.played and not pair.over

    def turn(self, command):
        """Steer by a command from now on.

        Parameters
        ----------
        command : (2,) speed and turn rate [m/s, rad/s], or None to stand

        Returns
        -------
        bool, whether there is something new to see
        """
        self._way = None
        return self._order(command)

    def tell(self, text):
        """Do what was typed: see :func:`commands.understood`.

        Parameters
        ----------
        text : str

        Returns
        -------
        str, what is done

        Raises
        ------
        ValueError : it means nothing, or there is no robot to do it; the text says which
        """
        order, loop = understood(text), self._loop
        if order == "exit":
            loop.leave()
            return "stopped, and the devices let go of; run takes them again"
        if order == "reset":
            ran = loop.running
            loop.reset()
            if ran:
                loop.run()
            return "map and pose begin anew"
        self._begin(*order)
        distance, angle = order
        return f"turning by {np.degrees(angle):g}°, then driving {distance:g} m"

    def _begin(self, distance, angle):
        """Begin a turn and then a straight way; the loop's steps call :meth:`steer`."""
        loop = self._loop
        if not loop.pair.drivable:
            raise ValueError("there is no robot here that could be driven: a recording plays")
        if not loop.pair.played:
            raise ValueError(f"drive when all {len(loop.pair.source)} recorded readings are played")
        if not loop.running:
            loop.run()
        self._way = Way(distance, angle, loop.pair.estimator.pose, loop.tops)
        self.steer()

    def steer(self):
        """Go on with a way, after a reading."""
        if self._way is not None:
            command = self._way.steer(self._loop.pair.estimator.pose)
            if command is None:
                self._way = None
            self._order(command)

    def let_go(self):
        """Nobody steers any more: a robot that drives on by itself stands."""
        self._way = None
        if self._own_clock:
            with suppress(Exception):  # one that is gone cannot be told, nor has to be
                self._loop.pair.drive(STAND)

    def _order(self, command):
        pair = self._loop.pair
        if self._loop.running and pair.drivable and pair.over:
            pair.command = command
            return False
        if command is None and not self._own_clock:
            return False
        self._loop.attempt(lambda: pair.drive(command or STAND))
        return True


class Way:
    """A turn and then a straight way, steered by where the robot believes to be.

    Parameters
    ----------
    distance, angle : float, forward and to the left [m, rad]
    pose : (3,) where it begins [m, m, rad]
    tops : (speed, turn rate) at most [m/s, rad/s]
    """

    def __init__(self, distance, angle, pose, tops):
        self._left, self._turn, self._tops = distance, angle, tops
        self._last, self._turning = np.array(pose, dtype=float), True

    def steer(self, pose):
        """The next command.

        Parameters
        ----------
        pose : (3,) where it is now [m, m, rad]

        Returns
        -------
        (2,) speed and turn rate [m/s, rad/s], or None at the goal
        """
        # by hand: workers of exercise 01 hold the views, but not the answers in slamlab.geometry
        x, y, theta = np.asarray(pose, dtype=float) - self._last
        forward = x * np.cos(self._last[2]) + y * np.sin(self._last[2])
        self._last = np.array(pose, dtype=float)
        self._turn -= remainder(theta, tau)
        if not self._turning:
            self._left -= np.copysign(np.hypot(x, y), forward)
        self._turning = self._turning and abs(self._turn) > NEAR[1]
        if not self._turning and abs(self._left) <= NEAR[0]:
            return None
        omega = _towards(self._turn, self._tops[1], NEAR[1])
        return (0.0 if self._turning else _towards(self._left, self._tops[0], NEAR[0])), omega


def _towards(left, top, near):
    """The speed that brings what is left to nothing, slower towards the end."""
    if abs(left) <= near:
        return 0.0
    return float(np.copysign(min(max(EAGER * abs(left), SLOWEST * top), top), left))
