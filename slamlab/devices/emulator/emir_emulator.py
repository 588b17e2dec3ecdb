"""eMIR emulator: state machine for the robot's side of the protocol."""

import errno
import math

import numpy as np

from slamlab.devices.emir import commands
from slamlab.devices.emir.frames import COMMAND, Framer
from slamlab.devices.emir.status import Status
from slamlab.devices.emulator.serial_line import Faults, SerialLine

STATUS_PERIOD = 0.1  # between status frames [s]
CONTROL_PERIOD = 0.01  # of the checks of goal, obstacle and watchdog [s]
BATTERY, INPUTS = 90, 0xF0  # 14.3 V
STANDING, MOVING, TRANSLATING, ROTATING = range(4)  # work modes
PATH, ANGLE = 0, 1  # indices of the counters


class EmirEmulator:
    """Emulated eMIR that receives commands and sends status frames.

    ``saturates``: whether the counters saturate; ``watchdog``: watchdog timeout [s] or None.
    """

    def __init__(self, body, saturates=False, faults=None, rng=None, watchdog=None, baud=57600):
        self._body, self._saturates, self.faults = body, saturates, faults or Faults()
        self.line = SerialLine(baud, self.faults, rng or np.random.default_rng(0))
        self._framer, self._watchdog = Framer(COMMAND), watchdog
        self._v = self._omega = self._mode = 0
        self._limits, self._goal, self._min_gap = [100, 100], None, 0.0
        self._zero_at, self._azimuth_zero, self._on = [0, 0], 0.0, True
        self._streaming, self._next_status, self._last_command, self._now = False, 0.0, 0.0, None
        self.commands = []

    @property
    def bad(self):
        """Number of received frames that contain wrong digits or a wrong checksum."""
        return self._framer.damage["bad frames"]

    def feed(self, data, now):
        """Receive bytes at ``now`` [s] and return bytes to send. Raises OSError when unplugged."""
        if self._now is None:  # the first call sets the start time
            self._now = self._last_command = now
        self._simulate_until(now)
        if self.faults.unplugged:
            raise OSError(errno.EIO, "Input/output error")
        for opcode, a, b in self._framer.feed(data):
            self.commands.append((opcode, a, b))
            self._last_command = now
            if opcode not in self.faults.silent and self._on:
                self._handle(opcode, a, b, now)
        return self.line.take(now)

    def _simulate_until(self, now):
        while self._now < now:
            self._now = min(self._now + CONTROL_PERIOD, now) if self._v or self._omega else now
            overdue = self._watchdog is not None and self._now - self._last_command > self._watchdog
            if overdue or self._arrived() or self._obstacle_near():
                self._drive(0, 0, STANDING)
            self._body.advance(self._v, self._omega, self._now)
            if self._streaming and self._now >= self._next_status:
                self.line.put(self._status().pack(), self._now)
                self._next_status = max(self._next_status + STATUS_PERIOD, self._now)

    def _handle(self, opcode, a, b, now):
        if opcode in (commands.STOP, commands.OFF):
            self._drive(0, 0, STANDING)
            self._on = opcode != commands.OFF
            self._streaming = self._streaming and self._on
        elif opcode == commands.MOVE:
            self._drive(_signed(a), _signed(b), MOVING)
        elif opcode == commands.TRANSLATE:
            self._drive_counts(PATH, _signed(a), b)
        elif opcode == commands.ROTATE:
            self._drive_counts(ANGLE, _signed(a), b)
        elif opcode == commands.INFO:
            self._streaming, self._next_status = a == 1, now
        elif opcode == commands.MIN_DISTANCE:
            self._min_gap = min(a, 50) / 100
        elif opcode in (commands.MAX_SPEED, commands.MAX_ROTATION):
            self._limits[opcode - commands.MAX_SPEED] = min(max(a, 10), 100)
        elif opcode == commands.RESET_AZIMUTH:
            self._azimuth_zero = self._body.azimuth()
        elif opcode == commands.RESET_COUNTERS:
            self._zero_at = list(self._body.counters())

    def _drive(self, v, omega, mode):
        fastest, quickest = self._limits
        self._v = min(max(v, -fastest), fastest)
        self._omega = min(max(omega, -quickest), quickest)
        self._mode, self._goal = mode, None
        self._body.advance(self._v, self._omega, self._now)

    def _drive_counts(self, which, counts, speed):
        speed = math.copysign(min(max(speed, 10), 100), counts) if counts else 0
        v, omega = (speed, 0) if which == PATH else (0, speed)
        self._drive(v, omega, TRANSLATING if which == PATH else ROTATING)
        self._goal = which, self._body.counters()[which] + counts, math.copysign(1, counts)

    def _arrived(self):
        if self._goal is None:
            return False
        which, goal, sign = self._goal
        return sign * (self._body.counters()[which] - goal) >= 0

    def _obstacle_near(self):
        return self._min_gap and self._v > 0 and min(self._body.proximity()[:4]) < self._min_gap

    def _status(self):
        counts = [n - zero for n, zero in zip(self._body.counters(), self._zero_at, strict=True)]
        if self._saturates:
            counts = [min(max(n, -128), 127) for n in counts]
        path, angle = ((n + 128) % 256 - 128 for n in counts)
        return Status(
            proximity=tuple(round(100 * r) for r in self._body.proximity()),
            battery=BATTERY,
            speed=round(self._v),
            rotation=round(self._omega),
            left=round(min(max(self._v - self._omega, -100), 100)),
            right=round(min(max(self._v + self._omega, -100), 100)),
            mode=self._mode,
            inputs=INPUTS,
            azimuth=int(math.degrees(self._body.azimuth() - self._azimuth_zero) % 360 / 2),
            path=path,
            angle=angle,
        )


def _signed(byte):
    return byte - 256 if byte > 127 else byte
