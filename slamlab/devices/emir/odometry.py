"""From eMIR's two counters to a pose: unwrapped, scaled, added up, asked for at any time."""

from collections import deque
from dataclasses import dataclass

import numpy as np

from slamlab.geometry import between, compose
from slamlab.simulator import arc

AHEAD = 0.3  # so far beyond the last frame a pose is extrapolated [s]
KEPT = 512  # poses
FULL = 64  # a counter that stops at its end is set back from here on
SOON = 10  # values within which a reset shows, or it was not heard


@dataclass(frozen=True)
class Calibration:
    """How this robot's numbers become metres and radians; measure yours.

    The thesis has 10 mm and 2° a count, another program for the same robots 10.3 mm and 2.14°:
    7 % in the turn spoil a map.

    Parameters
    ----------
    path : float [m] a count
    angle : float [rad] a count; negative where the robot counts clockwise
    top_speed : float, at 100 % [m/s]
    top_turn : float, at 100 %; negative where positive means clockwise [rad/s]
    """

    path: float = 0.01
    angle: float = np.radians(2)
    top_speed: float = 0.4
    top_turn: float = np.radians(100)

    def percent(self, v, omega):
        """Speed and turn rate [m/s, rad/s] as shares of what is at most possible [%]."""
        return 100 * v / self.top_speed, 100 * omega / self.top_turn


class Counter8:
    """A signed byte that counts: how far it went from one value to the next.

    Parameters
    ----------
    saturates : bool, whether it stops at its end instead of running over it
    """

    def __init__(self, saturates=False):
        self.saturates = saturates
        self.begin()

    def begin(self):
        """Forget what was: the next value is the first."""
        self._last, self._expecting = None, 0

    def expect_reset(self):
        """The counter was told to begin at 0 again; when it will, nobody knows."""
        self._expecting = SOON

    @property
    def full(self):
        """bool, whether it will soon stop and should be set back."""
        return self.saturates and not self._expecting and abs(self._last or 0) >= FULL

    def advance(self, value):
        """Counts since the last value; 0 at the first one.

        Parameters
        ----------
        value : int, −128 to 127

        Returns
        -------
        int
        """
        last, self._last = self._last, value
        if last is None:
            return 0
        change = value - last if self.saturates else (value - last + 128) % 256 - 128
        if self._expecting:
            self._expecting -= 1
            if abs(value) <= abs(change):
                self._expecting = 0
                return value
        return change


class Odometry:
    """The way of the robot, as its counters tell it.

    Parameters
    ----------
    calibration : Calibration
    saturates : bool, see :class:`Counter8`
    """

    def __init__(self, calibration, saturates=False):
        self.calibration = calibration
        self.path, self.angle = Counter8(saturates), Counter8(saturates)
        self._poses, self._gap = deque(maxlen=KEPT), False

    @property
    def full(self):
        """bool, whether a counter will soon stop and they should be set back."""
        return self.path.full or self.angle.full

    @property
    def until(self):
        """float, when the counters were last read [s]; −∞ before that."""
        return self._poses[-1][0] if self._poses else -np.inf

    def expect_reset(self):
        """The counters were told to begin at 0 again; see :class:`Counter8`."""
        self.path.expect_reset()
        self.angle.expect_reset()

    def expect_gap(self):
        """The connection was lost: a robot whose counters are 0 then was switched on anew."""
        self._gap = True

    def advance(self, path, angle, time):
        """Take the counters in.

        Parameters
        ----------
        path, angle : int, −128 to 127
        time : float, when they were read [s]

        Returns
        -------
        (3,) pose [m, m, rad]
        """
        if self._gap and path == angle == 0:
            self.path.begin()
            self.angle.begin()
        self._gap = False
        d = self.path.advance(path) * self.calibration.path
        turn = self.angle.advance(angle) * self.calibration.angle
        before = self._poses[-1][1] if self._poses else np.zeros(3)
        pose = compose(before, arc(d - turn / 2, d + turn / 2, 1.0))
        self._poses.append((time, pose))
        return pose

    def pose_at(self, time):
        """Where it was, between two frames by interpolation, soon after the last by extrapolation.

        Parameters
        ----------
        time : float [s]

        Returns
        -------
        (3,) pose [m, m, rad]
        """
        poses = list(self._poses)  # another thread adds to them
        if not poses:
            return np.zeros(3)
        later = next((k for k, (t, _) in enumerate(poses) if t >= time), len(poses) - 1)
        if later == 0:
            return poses[0][1]
        (t0, before), (t1, after) = poses[later - 1], poses[later]
        if t1 <= t0:
            return after
        share = (min(time, t1 + AHEAD) - t0) / (t1 - t0)
        return compose(before, share * between(before, after))
