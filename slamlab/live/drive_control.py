"""Teleoperation: named drive commands as velocities, and typed moves."""

from contextlib import suppress

import numpy as np

from slamlab.geometry import between

COMMANDS = {"forward": (1, 0), "back": (-1, 0), "left": (0, 1), "right": (0, -1), "stop": None}
"""Commands by name: fractions of top speed and top turn rate [1]; None stops."""

WORD_COMMANDS = "reset", "exit"  # typed commands without numbers
MAX_MOVE = 100.0, 3600.0  # of a typed move [m, degree]
GAIN = 1.5  # of the proportional controller: speed for each remaining metre [1/s]
MIN_SPEED_SHARE = 0.1  # fraction of the top speed near the goal
GOAL_TOLERANCE = 0.01, np.radians(1)  # a goal counts as reached within this [m, rad]
NOT_DRIVABLE = "this source is a recording or a lidar alone: there is no robot to drive"
STOP = 0.0, 0.0  # command: speed, turn rate [m/s, rad/s]


def velocities(name, tops):
    """Return the velocities [m/s, rad/s] of a named command, given the top velocities; None for
    stop.
    """
    if COMMANDS[name] is None:
        return None
    (v, omega), (v_top, omega_top) = COMMANDS[name], tops
    return v * v_top, omega * omega_top


def parse_command(text):
    """Parse "reset", "exit" or "distance, angle" [m, degree]; return the word or [m, rad].
    ValueError: the text is invalid or the move is too far.
    """
    word, shown = text.strip().lower(), repr(text.strip()[:20])
    if word in WORD_COMMANDS:
        return word
    try:
        distance, angle = (float(part) for part in text.split(","))
    except ValueError:
        raise ValueError(
            f"{shown} is not a command. Type metres, degrees (such as 0.5, 30), reset or exit"
        ) from None
    metres, degrees = MAX_MOVE
    if not (abs(distance) <= metres and abs(angle) <= degrees):
        raise ValueError(
            f"{shown} is too far: the limits of a move are {metres:g} m and {degrees:g}°"
        )
    return distance, float(np.radians(angle))


class DriveControl:
    """Velocity commands to the robot of a run loop; ``moving``: whether a command is active. A
    simulated robot executes the command at each step after the end of its recorded readings. A real
    robot receives a command once and keeps it.
    """

    def __init__(self, loop):
        self._loop, self._move, self.moving = loop, None, False

    @property
    def _real_time(self):
        pair = self._loop.pair
        return pair.drivable and pair.played and not pair.exhausted

    def set_velocity(self, command):
        """Set the command [m/s, rad/s] (None: stop); return whether the view must be updated."""
        self._move = None
        return self._send_command(command)

    def execute(self, text):
        """Execute a typed command and return a message. ValueError: the command is invalid or
        cannot be executed.
        """
        parsed, loop = parse_command(text), self._loop
        if parsed == "exit":
            loop.release()
            return "The run is stopped and the devices are released. Run opens them again."
        if parsed == "reset":
            ran = loop.running
            loop.reset()
            if ran:
                loop.run()
            return "The map and the pose are reset."
        self._start_move(*parsed)
        distance, angle = parsed
        return f"turning by {np.degrees(angle):g}°, then driving {distance:g} m"

    def _start_move(self, distance, angle):
        loop = self._loop
        if not loop.pair.drivable:
            raise ValueError(NOT_DRIVABLE)
        if not loop.pair.played:
            raise ValueError(
                f"you can drive after the last of {len(loop.pair.source)} recorded readings"
            )
        if not loop.running:
            loop.run()
        self._move = TurnThenDrive(distance, angle, loop.pair.estimator.pose, loop.tops)
        self.steer()

    def steer(self):
        """Perform a control step of a typed move."""
        if self._move is not None:
            command = self._move.steer(self._loop.pair.estimator.pose)
            if command is None:
                self._move = None
            self._send_command(command)

    def release(self):
        """Release the controls; stop a real robot, because it would otherwise keep its command."""
        self._move, self.moving = None, False
        if self._real_time:
            with suppress(Exception):  # the robot may be disconnected
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
    """Controller of a turn in place [rad], then a straight line [m], using the estimated pose."""

    def __init__(self, distance, angle, pose, tops):
        self._distance_left, self._angle_left, self._tops = distance, angle, tops
        self._last, self._turning = np.array(pose, dtype=float), True

    def steer(self, pose):
        """Return the next command [m/s, rad/s] at a pose, or None at the goal."""
        forward, left, turn = between(self._last, pose)
        self._last = np.array(pose, dtype=float)
        self._angle_left -= turn
        if not self._turning:
            self._distance_left -= np.copysign(np.hypot(forward, left), forward)
        self._turning = self._turning and abs(self._angle_left) > GOAL_TOLERANCE[1]
        if not self._turning and abs(self._distance_left) <= GOAL_TOLERANCE[0]:
            return None
        omega = _proportional_speed(self._angle_left, self._tops[1], GOAL_TOLERANCE[1])
        if self._turning:
            return 0.0, omega
        return _proportional_speed(self._distance_left, self._tops[0], GOAL_TOLERANCE[0]), omega


def _proportional_speed(remaining, top, tolerance):
    if abs(remaining) <= tolerance:
        return 0.0
    return float(
        np.copysign(min(max(GAIN * abs(remaining), MIN_SPEED_SHARE * top), top), remaining)
    )
