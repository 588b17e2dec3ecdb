"""Wheel odometry (dead reckoning) from eMIR's two 8-bit encoder counters."""

from collections import deque
from dataclasses import dataclass

import numpy as np

from slamlab.geometry import between, compose
from slamlab.simulation.differential_drive import arc

MAX_EXTRAPOLATION = 0.3  # of a pose beyond the last frame [s]
POSE_HISTORY = 512  # poses for interpolation
RESET_AT = 64  # count at which a saturating counter is reset
RESET_WINDOW = 10  # values within which a reset appears; otherwise the command was lost


@dataclass(frozen=True)
class Calibration:
    """Odometry calibration of one robot; the defaults are the values of the thesis.

    Parameters
    ----------
    path : float, distance per count [m]
    angle : float, rotation per count; negative if the robot counts clockwise [rad]
    top_speed : float, speed at 100 % [m/s]
    top_turn : float, turn rate at 100 %; negative if positive means clockwise [rad/s]
    """

    path: float = 0.01
    angle: float = np.radians(2)
    top_speed: float = 0.4
    top_turn: float = np.radians(100)

    def percent(self, v, omega):
        """Convert a speed and a turn rate [m/s, rad/s] to percentages of their maxima."""
        return 100 * v / self.top_speed, 100 * omega / self.top_turn


class CounterUnwrapper:
    """Unwrapper of a signed 8-bit encoder counter, which can overflow or saturate."""

    def __init__(self, saturates=False):
        self.saturates = saturates
        self.restart()

    def restart(self):
        self._last, self._reset_due = None, 0

    def expect_reset(self):
        """Expect that a reset command sets the counter to 0 within the next RESET_WINDOW values."""
        self._reset_due = RESET_WINDOW

    @property
    def near_limit(self):
        """Whether the counter is close to saturation and should be reset."""
        return self.saturates and not self._reset_due and abs(self._last or 0) >= RESET_AT

    def advance(self, value):
        """Return the unwrapped increment since the last value, or 0 at first. Equation (14.7)."""
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
    """Integrates encoder increments to a pose (dead reckoning), and keeps a history of poses."""

    def __init__(self, calibration, saturates=False):
        self.calibration = calibration
        self.path, self.angle = CounterUnwrapper(saturates), CounterUnwrapper(saturates)
        self._poses, self._gap = deque(maxlen=POSE_HISTORY), False

    @property
    def near_limit(self):
        """Whether a counter is close to saturation and both counters should be reset."""
        return self.path.near_limit or self.angle.near_limit

    @property
    def last_time(self):
        """Time of the last counter values [s], or −∞ before the first values."""
        return self._poses[-1][0] if self._poses else -np.inf

    def expect_reset(self):
        self.path.expect_reset()
        self.angle.expect_reset()

    def expect_gap(self):
        """Expect a gap after a lost connection; if the counters are then 0, the robot restarted."""
        self._gap = True

    def advance(self, path, angle, time):
        """Integrate counter values read at the given time [s]; return the pose (3,) [m, m, rad]."""
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
        """Interpolate the pose (3,) [m, m, rad] at the given time [s]; extrapolate up to 0.3 s."""
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
