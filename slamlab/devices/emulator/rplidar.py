"""An emulated RPLIDAR: a state machine of bytes and time, without clock, thread or port.

``feed(bytes, now) -> bytes`` takes what a client wrote and gives what has gone over the line by
then, with the timing and the bandwidth of the real one.
"""

import errno
import struct

import numpy as np

from slamlab.devices.emulator.line import Faults, Line
from slamlab.devices.emulator.packets import PACKERS, SIZES
from slamlab.devices.emulator.parser import RequestParser
from slamlab.devices.rplidar.answers import Answer, Descriptor
from slamlab.devices.rplidar.connect import KNOWS_CONF, KNOWS_EXPRESS, Mode
from slamlab.devices.rplidar.requests import Command, Conf

BANNER = b"RP LIDAR System.\r\nFirmware Ver %d.%d, HW Ver 5\r\nModel: 28\r\n"
BOOTS = 0.02, 0.3  # the banner comes after so long, and then it hears again [s]
FULL_PWM, FULL_RATE = 660, 10.0  # turns a second [Hz]
MODES = (
    Mode(0, "Standard", 508e-6, 12.0, Answer.SCAN),
    Mode(1, "Express", 254e-6, 12.0, Answer.EXPRESS),
    Mode(2, "Boost", 127e-6, 12.0, Answer.ULTRA),
)
GOES_ON = {Command.SET_MOTOR_PWM, Command.GET_ACC_BOARD_FLAG}
SERIAL = bytes.fromhex("ABB69AF2C1EA9FC2A2EB92F138653C00")
LONGEST_STEP = 0.5  # of samples made at a time: who does not ask for longer has lost them [s]


class RplidarMachine:
    """An RPLIDAR A2M8.

    Parameters
    ----------
    measure : callable(times (n,) [s], directions (n,) clockwise [degree]) -> (n,) [mm], 0 nothing
    firmware : (major, minor); before 1.24 it does not know its configuration
    modes : Modes it has
    typical : int, the mode that it recommends
    health : (status, code)
    heals : bool, whether a RESET mends its health
    spinning : bool, whether the motor turns already, as after a program that died
    scanning : Answer in whose mode it scans already, or None
    spin_up : float, time until the rotation is even [s]
    faults : Faults
    baud : int [bit/s]
    rng : numpy.random.Generator, of the faults
    """

    def __init__(
        self,
        measure,
        firmware=(1, 29),
        modes=MODES,
        typical=2,
        health=(0, 0),
        heals=True,
        spinning=True,
        scanning=None,
        spin_up=0.5,
        faults=None,
        baud=115200,
        rng=None,
    ):
        self._measure, self.firmware, self.modes, self.typical = measure, firmware, modes, typical
        self.health, self._heals, self.spin_up = health, heals, spin_up
        self.faults = faults or Faults()
        self.line = Line(baud, self.faults, rng or np.random.default_rng(0))
        self._parser = RequestParser()
        self.pwm, self._even, self._phase = FULL_PWM if spinning else 0, 0.0, (0.0, 0.0)
        self._scan, self._deaf, self._now = None, 0.0, None
        self._begins = scanning
        self.requests = []

    def feed(self, data, now):
        """Take bytes in, give bytes out.

        Parameters
        ----------
        data : bytes, from the client
        now : float [s], never smaller than before

        Returns
        -------
        bytes, to the client

        Raises
        ------
        OSError : unplugged
        """
        if self.faults.unplugged:
            raise OSError(errno.EIO, "Input/output error")
        if self._now is None:  # time begins with the first call
            self._even, self._phase = now, (now, 0.0)
            if self._begins is not None:
                self._begin(next(m for m in self.modes if m.answer == self._begins), now)
        self._now = now
        self._sample(now)
        for command, payload in self._parser.feed(data, now):
            self.requests.append((command, payload))
            if now >= self._deaf and command not in self.faults.silent:
                self._handle(command, payload, now)
        return self.line.take(now)

    @property
    def rate(self):
        """float, turns a second [Hz]."""
        return self.pwm / FULL_PWM * FULL_RATE

    def _handle(self, command, payload, now):
        if command not in GOES_ON:
            self._scan = None  # a new request ends a scan
        answers = {
            Command.GET_INFO: self._info,
            Command.GET_HEALTH: lambda: (Answer.HEALTH, struct.pack("<BH", *self.health)),
            Command.GET_SAMPLERATE: self._samplerate,
            Command.GET_LIDAR_CONF: lambda: self._conf(payload),
            Command.GET_ACC_BOARD_FLAG: lambda: (Answer.ACC_BOARD_FLAG, struct.pack("<I", 1)),
        }
        if command in answers:
            answer = answers[command]()
            if answer is not None:
                kind, body = answer
                self.line.put(Descriptor(len(body), False, kind).pack() + body, now)
        elif command in (Command.SCAN, Command.FORCE_SCAN):
            self._start(self.modes[0], now, force=command == Command.FORCE_SCAN)
        elif command == Command.EXPRESS_SCAN and self.firmware >= KNOWS_EXPRESS:
            self._express(payload, now)
        elif command == Command.SET_MOTOR_PWM:
            self._turn(struct.unpack("<H", payload)[0] if len(payload) == 2 else self.pwm, now)
        elif command == Command.RESET:
            self._reset(now)

    def _info(self):
        major, minor = self.firmware
        return Answer.INFO, bytes([0x28, minor, major, 5]) + SERIAL

    def _samplerate(self):
        if self.firmware < KNOWS_EXPRESS:
            return None
        return Answer.SAMPLERATE, struct.pack("<HH", 508, 254)

    def _conf(self, payload):
        if self.firmware < KNOWS_CONF or len(payload) < 4:
            return None
        what = int.from_bytes(payload[:4], "little")
        number = int.from_bytes(payload[4:6], "little")
        mode = self.modes[number] if number < len(self.modes) else None
        values = {
            Conf.MODE_COUNT: struct.pack("<H", len(self.modes)),
            Conf.TYPICAL_MODE: struct.pack("<H", self.typical),
            Conf.DESIRED_ROTATION: struct.pack("<HH", round(60 * FULL_RATE), FULL_PWM),
        }
        if mode is not None:
            values[Conf.US_PER_SAMPLE] = struct.pack("<I", round(mode.period * 1e6 * 256))
            values[Conf.MAX_DISTANCE] = struct.pack("<I", round(mode.range_max * 256))
            values[Conf.ANSWER_TYPE] = bytes([mode.answer])
            values[Conf.NAME] = mode.name.encode() + b"\0"
        return (Answer.CONF, payload[:4] + values[what]) if what in values else None

    def _express(self, payload, now):
        number = payload[0] if len(payload) == 5 else len(self.modes)
        if self.firmware < KNOWS_CONF or number == 0:  # mode 0 asks for the legacy capsules
            number = 1
        if number < len(self.modes):
            self._start(self.modes[number], now)

    def _start(self, mode, now, force=False):
        if self.health[0] == 2:
            return
        self.line.put(Descriptor(SIZES[mode.answer], True, mode.answer).pack(), now)
        self._begin(mode, now if force else max(now, self._even))

    def _begin(self, mode, at):
        """Sample from a time on."""
        self._scan, self._next, self._first = mode, at, True

    def _turn(self, pwm, now):
        if pwm and not self.pwm:
            self._even = now + self.spin_up
            if self._scan is not None:
                self._next = max(self._next, self._even)
        self._phase = now, self._angle(now)
        self.pwm = pwm

    def _reset(self, now):
        self._deaf = now + BOOTS[1]
        if self._heals:
            self.health = 0, 0
        self.line.put(BANNER % self.firmware, now + BOOTS[0])

    def _angle(self, times):
        at, angle = self._phase
        return angle + 360 * self.rate * (times - at)

    def _sample(self, now):
        """Make the packets whose samples are taken by now."""
        mode = self._scan
        if mode is None:
            return
        if self.faults.stalled or not self.pwm:
            self._next = max(self._next, now)
            return
        packer, samples, ahead = PACKERS[mode.answer]
        self._next = max(self._next, now - LONGEST_STEP)
        count = int((now - self._next) / mode.period - 1.5 - ahead) // samples
        batch = max(count, 1) if samples == 1 else 1
        while count > 0:
            times = self._next + mode.period * np.arange(batch * samples + ahead)
            step = 360 * self.rate * mode.period
            angle = self._angle(times)
            packets = packer(
                angle, step, lambda a, t=times: self._measure(t, np.mod(a, 360)), self._first
            )
            taken = self._next + mode.period * (samples * np.arange(1, len(packets) + 1) + 0.5)
            for packet, ready in zip(packets, taken, strict=True):
                self.line.put(packet, ready)
            self._next += batch * samples * mode.period
            self._first, count = False, count - batch
