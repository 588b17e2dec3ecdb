"""An emulated eMIR: a state machine of bytes and time; its body is somebody else's.

``feed(bytes, now) -> bytes``, also with no bytes: only to let time pass.
"""

import errno
import math

import numpy as np

from slamlab.devices.emir import commands
from slamlab.devices.emir.frames import COMMAND, Framer
from slamlab.devices.emir.status import Status
from slamlab.devices.emulator.line import Faults, Line

STATUS_PERIOD = 0.1  # [s]
CONTROL = 0.01  # how often it looks whether it has arrived [s]
BATTERY, INPUTS = 90, 0xF0  # 14.3 V
STANDING, MOVING, TRANSLATING, ROTATING = range(4)
PATH, ANGLE = 0, 1


class EmirMachine:
    """An eMIR.

    Parameters
    ----------
    body : Body
    saturates : bool, whether its counters stop at their end instead of running over
    faults : Faults
    rng : numpy.random.Generator, of the faults
    watchdog : float, without a command for so long it stops [s], or None
    baud : int [bit/s]

    ``commands`` are those that came, ``bad`` counts the frames that were none.
    """

    def __init__(self, body, saturates=False, faults=None, rng=None, watchdog=None, baud=57600):
        self._body, self._saturates, self.faults = body, saturates, faults or Faults()
        self.line = Line(baud, self.faults, rng or np.random.default_rng(0))
        self._framer, self._watchdog = Framer(COMMAND), watchdog
        self._v = self._omega = self._mode = 0
        self._limits, self._goal, self._keep_off = [100, 100], None, 0.0
        self._zero, self._north, self._on = [0, 0], 0.0, True
        self._telling, self._next, self._heard, self._now = False, 0.0, 0.0, None
        self.commands = []

    @property
    def bad(self):
        """int, frames whose digits or checksum were wrong."""
        return self._framer.damage["bad frames"]

    def feed(self, data, now):
        """Take bytes in, give bytes out.

        Parameters
        ----------
        data : bytes
        now : float [s], never smaller than before

        Returns
        -------
        bytes

        Raises
        ------
        OSError : unplugged
        """
        if self._now is None:  # time begins with the first call
            self._now = self._heard = now
        self._live(now)
        if self.faults.unplugged:
            raise OSError(errno.EIO, "Input/output error")
        for opcode, a, b in self._framer.feed(data):
            self.commands.append((opcode, a, b))
            self._heard = now
            if opcode not in self.faults.silent and self._on:
                self._handle(opcode, a, b, now)
        return self.line.take(now)

    def _live(self, now):
        """Drive up to now, and tell what is due."""
        while self._now < now:
            self._now = min(self._now + CONTROL, now) if self._v or self._omega else now
            overdue = self._watchdog is not None and self._now - self._heard > self._watchdog
            if overdue or self._arrived() or self._near():
                self._drive(0, 0, STANDING)
            self._body.advance(self._v, self._omega, self._now)
            if self._telling and self._now >= self._next:
                self.line.put(self._status().pack(), self._now)
                self._next = max(self._next + STATUS_PERIOD, self._now)

    def _handle(self, opcode, a, b, now):
        if opcode in (commands.STOP, commands.OFF):
            self._drive(0, 0, STANDING)
            self._on = opcode != commands.OFF
            self._telling = self._telling and self._on
        elif opcode == commands.MOVE:
            self._drive(_signed(a), _signed(b), MOVING)
        elif opcode == commands.TRANSLATE:
            self._go(PATH, _signed(a), b)
        elif opcode == commands.ROTATE:
            self._go(ANGLE, _signed(a), b)
        elif opcode == commands.INFO:
            self._telling, self._next = a == 1, now
        elif opcode == commands.MIN_DISTANCE:
            self._keep_off = min(a, 50) / 100
        elif opcode in (commands.MAX_SPEED, commands.MAX_ROTATION):
            self._limits[opcode - commands.MAX_SPEED] = min(max(a, 10), 100)
        elif opcode == commands.RESET_AZIMUTH:
            self._north = self._body.azimuth()
        elif opcode == commands.RESET_COUNTERS:
            self._zero = list(self._body.counters())

    def _drive(self, v, omega, mode):
        fastest, quickest = self._limits
        self._v = min(max(v, -fastest), fastest)
        self._omega = min(max(omega, -quickest), quickest)
        self._mode, self._goal = mode, None
        self._body.advance(self._v, self._omega, self._now)

    def _go(self, which, counts, speed):
        """Drive or turn by so many counts."""
        speed = math.copysign(min(max(speed, 10), 100), counts) if counts else 0
        v, omega = (speed, 0) if which == PATH else (0, speed)
        self._drive(v, omega, TRANSLATING if which == PATH else ROTATING)
        self._goal = which, self._body.counters()[which] + counts, math.copysign(1, counts)

    def _arrived(self):
        if self._goal is None:
            return False
        which, goal, sign = self._goal
        return sign * (self._body.counters()[which] - goal) >= 0

    def _near(self):
        """Whether something ahead is nearer than it was told to come."""
        return self._keep_off and self._v > 0 and min(self._body.proximity()[:4]) < self._keep_off

    def _status(self):
        counts = [n - zero for n, zero in zip(self._body.counters(), self._zero, strict=True)]
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
            azimuth=int(math.degrees(self._body.azimuth() - self._north) % 360 / 2),
            path=path,
            angle=angle,
        )


def _signed(byte):
    return byte - 256 if byte > 127 else byte
