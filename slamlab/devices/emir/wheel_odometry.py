"""Wheel odometry (dead reckoning) from eMIR's two 8-bit tick counters: unwrap, scale, integrate."""

from collections import deque
from dataclasses import dataclass

import numpy as np

from slamlab.geometry import between, compose
from slamlab.simulation.differential_drive import arc

MAX_EXTRAPOLATION = 0.3  # most that a pose is extrapolated beyond the last frame [s]
POSE_HISTORY = 512  # poses kept for interpolation
RESET_AT = 64  # count from which on a counter that saturates is reset
RESET_WINDOW = 10  # values within which a reset shows, or it was lost


@dataclass(frozen=True)
class Calibration:
    """Odometry calibration: metres and radians per count of this robot; measure yours.

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
        """Convert speed and turn rate [m/s, rad/s] to percent of their maximum [%]."""
        return 100 * v / self.top_speed, 100 * omega / self.top_turn


class CounterUnwrapper:
    """Unwraps a signed 8-bit counter: increments from value to value across its wrap-around.

    Parameters
    ----------
    saturates : bool, whether it stops at its end instead of wrapping around
    """

    def __init__(self, saturates=False):
        self.saturates = saturates
        self.restart()

    def restart(self):
        """Restart: the next value is the first."""
        self._last, self._reset_due = None, 0

    def expect_reset(self):
        """Expect a reset to 0, which was commanded; when it comes, nobody knows."""
        self._reset_due = RESET_WINDOW

    @property
    def near_limit(self):
        """Whether it will soon saturate and should be reset: bool."""
        return self.saturates and not self._reset_due and abs(self._last or 0) >= RESET_AT

    def advance(self, value):
        """Unwrapped increment since the last value; 0 at the first one.

        Equation (14.7).

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
        if self._reset_due:
            self._reset_due -= 1
            if abs(value) <= abs(change):
                self._reset_due = 0
                return value
        return change


class Odometry:
    """Wheel odometry: integrates counter increments into a pose (dead reckoning).

    Parameters
    ----------
    calibration : Calibration
    saturates : bool, see :class:`CounterUnwrapper`
    """

    def __init__(self, calibration, saturates=False):
        self.calibration = calibration
        self.path, self.angle = CounterUnwrapper(saturates), CounterUnwrapper(saturates)
        self._poses, self._gap = deque(maxlen=POSE_HISTORY), False

    @property
    def near_limit(self):
        """Whether a counter will soon saturate and they should be reset: bool."""
        return self.path.near_limit or self.angle.near_limit

    @property
    def last_time(self):
        """Time of the last counters [s], float; −∞ before any."""
        return self._poses[-1][0] if self._poses else -np.inf

    def expect_reset(self):
        """Expect a reset of the counters; see :class:`CounterUnwrapper`."""
        self.path.expect_reset()
        self.angle.expect_reset()

    def expect_gap(self):
        """Expect a gap after a lost connection: counters of 0 are then of a restarted robot."""
        self._gap = True

    def advance(self, path, angle, time):
        """Integrate the odometry increment of new counters.

        Parameters
        ----------
        path, angle : int, −128 to 127
        time : float, when they were read [s]

        Returns
        -------
        (3,) pose [m, m, rad]
        """
        if self._gap and path == angle == 0:
            self.path.restart()
            self.angle.restart()
        self._gap = False
        d = self.path.advance(path) * self.calibration.path
        turn = self.angle.advance(angle) * self.calibration.angle
        before = self._poses[-1][1] if self._poses else np.zeros(3)
        pose = compose(before, arc(d - turn / 2, d + turn / 2, 1.0))
        self._poses.append((time, pose))
        return pose

    def pose_at(self, time):
        """Pose at a time: interpolated between two frames, extrapolated soon after the last.

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
        fraction = (min(time, t1 + MAX_EXTRAPOLATION) - t0) / (t1 - t0)
        return compose(before, fraction * between(before, after))
