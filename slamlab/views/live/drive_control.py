"""Teleoperation (driving by hand, keyboard driving): named velocity commands, or typed moves."""

from contextlib import suppress
from math import remainder, tau

import numpy as np

from slamlab.views.live.drive_commands import parse_command

GAIN = 1.5  # of the proportional controller: speed for each metre that is left [1/s]
MIN_SPEED_SHARE = 0.1  # share of the top speed with which a goal is reached
GOAL_TOLERANCE = 0.01, np.radians(1)  # a goal counts as reached within this [m, rad]
STOP = 0.0, 0.0  # command: speed, turn rate [m/s, rad/s]


class DriveControl:
    """Drive control: sends the robot of a run loop its velocity commands.

    A simulated robot that has played its part moves by the command of each step; a real one is told
    once, and drives on by itself.

    Parameters
    ----------
    loop : RunLoop

    ``moving`` says whether a command to move holds.
    """

    def __init__(self, loop):
        self._loop, self._move, self.moving = loop, None, False

    @property
    def _real_time(self):
        """bool, whether the robot drives on by itself, in real time: a device, not a simulation."""
        pair = self._loop.pair
        return pair.drivable and pair.played and not pair.exhausted

    def set_velocity(self, command):
        """Set the velocity command that holds from now on (teleoperation).

        Parameters
        ----------
        command : (2,) speed and turn rate [m/s, rad/s], or None to stand

        Returns
        -------
        bool, whether there is something new to see
        """
        self._move = None
        return self._send_command(command)

    def execute(self, text):
        """Execute a typed command: see :func:`drive_commands.parse_command`.

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
        parsed, loop = parse_command(text), self._loop
        if parsed == "exit":
            loop.release()
            return "stopped, and the devices released; run opens them again"
        if parsed == "reset":
            ran = loop.running
            loop.reset()
            if ran:
                loop.run()
            return "map and pose are reset"
        self._start_move(*parsed)
        distance, angle = parsed
        return f"turning by {np.degrees(angle):g}°, then driving {distance:g} m"

    def _start_move(self, distance, angle):
        """Begin a turn and then a straight line; the loop's steps call :meth:`steer`."""
        loop = self._loop
        if not loop.pair.drivable:
            raise ValueError("there is no robot here that could be driven: a recording plays")
        if not loop.pair.played:
            raise ValueError(f"drive when all {len(loop.pair.source)} recorded readings are played")
        if not loop.running:
            loop.run()
        self._move = TurnThenDrive(distance, angle, loop.pair.estimator.pose, loop.tops)
        self.steer()

    def steer(self):
        """Control step of a typed move, after a reading: the next command, or stop at the goal."""
        if self._move is not None:
            command = self._move.steer(self._loop.pair.estimator.pose)
            if command is None:
                self._move = None
            self._send_command(command)

    def release(self):
        """Release the controls: a robot that drives on by itself is stopped."""
        self._move, self.moving = None, False
        if self._real_time:
            with suppress(Exception):  # one that is gone cannot be told, nor has to be
                self._loop.pair.drive(STOP)

    def _send_command(self, command):
        pair, self.moving = self._loop.pair, command is not None
        if self._loop.running and pair.drivable and pair.exhausted:
            pair.command = command
            return False
        if command is None and not self._real_time:
            return False
        self._loop.attempt(lambda: pair.drive(command or STOP))
        return True


class TurnThenDrive:
    """Controller of a turn in place, then a straight line, closed over the estimated pose.

    Parameters
    ----------
    distance, angle : float, forward and to the left [m, rad]
    pose : (3,) where it begins [m, m, rad]
    tops : (speed, turn rate) at most [m/s, rad/s]
    """

    def __init__(self, distance, angle, pose, tops):
        self._distance_left, self._angle_left, self._tops = distance, angle, tops
        self._last, self._turning = np.array(pose, dtype=float), True

    def steer(self, pose):
        """Next velocity command of the proportional controller.

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
        self._angle_left -= remainder(theta, tau)
        if not self._turning:
            self._distance_left -= np.copysign(np.hypot(x, y), forward)
        self._turning = self._turning and abs(self._angle_left) > GOAL_TOLERANCE[1]
        if not self._turning and abs(self._distance_left) <= GOAL_TOLERANCE[0]:
            return None
        omega = _proportional_speed(self._angle_left, self._tops[1], GOAL_TOLERANCE[1])
        if self._turning:
            return 0.0, omega
        return _proportional_speed(self._distance_left, self._tops[0], GOAL_TOLERANCE[0]), omega


def _proportional_speed(remaining, top, tolerance):
    """Proportional control, saturated at ``top``: the speed towards nothing remaining."""
    if abs(remaining) <= tolerance:
        return 0.0
    return float(
        np.copysign(min(max(GAIN * abs(remaining), MIN_SPEED_SHARE * top), top), remaining)
    )
