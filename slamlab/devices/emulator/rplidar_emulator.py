"""RPLIDAR emulator: the protocol as a state machine of bytes and time, without clock or port.

``feed(bytes, now) -> bytes`` takes what a client wrote, if anything, and gives what has gone over
the line by then, with the timing and the bandwidth of the real one.
"""

import errno
import struct

import numpy as np

from slamlab.devices.emulator.packet_encoder import PACKET_SIZES
from slamlab.devices.emulator.scan_head import NOMINAL_PWM, NOMINAL_RATE, Motor, ScanSampler
from slamlab.devices.emulator.serial_line import Faults, SerialLine
from slamlab.devices.rplidar.request_parser import RequestParser
from slamlab.devices.rplidar.requests import NON_INTERRUPTING, Command, Conf
from slamlab.devices.rplidar.responses import AnswerType, Descriptor
from slamlab.devices.rplidar.scan_modes import CONF_SINCE, EXPRESS_SINCE, ScanMode

BANNER = b"RP LIDAR System.\r\nFirmware Ver %d.%d, HW Ver 5\r\nModel: 28\r\n"
BOOT_TIMES = 0.02, 0.3  # from a RESET to the boot banner, and to the first request served [s]
MODES = (
    ScanMode(0, "Standard", 508e-6, 12.0, AnswerType.SCAN),
    ScanMode(1, "Express", 254e-6, 12.0, AnswerType.EXPRESS),
    ScanMode(2, "Boost", 127e-6, 12.0, AnswerType.ULTRA),
)
SERIAL = bytes.fromhex("ABB69AF2C1EA9FC2A2EB92F138653C00")  # serial number that it tells
PROTECTED = 2  # health status in which it does not scan


class RPLidarEmulator:
    """Emulator of an RPLIDAR A2M8: requests in, responses and scan data out.

    Parameters
    ----------
    measure : callable(times (n,) [s], directions (n,) clockwise [degree]) -> (n,) [mm], 0 nothing
    firmware : (major, minor); before 1.24 it does not know its configuration
    modes : Modes it has
    typical : int, the mode that it recommends
    health : (status, code)
    reset_heals : bool, whether a RESET makes its health good
    spinning : bool, whether the motor turns already, as after a program that died
    scanning : AnswerType in whose mode it scans already, or None
    spin_up : float, time until the rotation is even [s]
    faults : Faults
    baud : int [bit/s]
    rng : numpy.random.Generator, of the faults and of where the head stands at first

    ``requests`` are those that came.
    """

    def __init__(
        self,
        measure,
        firmware=(1, 29),
        modes=MODES,
        typical=2,
        health=(0, 0),
        reset_heals=True,
        spinning=True,
        scanning=None,
        spin_up=0.5,
        faults=None,
        baud=115200,
        rng=None,
    ):
        self._measure, self.firmware, self.modes, self.typical = measure, firmware, modes, typical
        self.health, self._reset_heals = health, reset_heals
        self.faults = faults or Faults()
        rng = rng or np.random.default_rng(0)
        self.line = SerialLine(baud, self.faults, rng)
        self.motor = Motor(NOMINAL_PWM if spinning else 0, spin_up, rng.uniform(0, 360))
        self._parser, self._scan, self._booting_until = RequestParser(), None, -np.inf
        self._scanning, self._begun = scanning, False
        self.requests = []

    @property
    def pwm(self):
        """PWM (duty cycle) of the motor, int, 0 to 1023."""
        return self.motor.pwm

    def feed(self, data, now):
        """Feed bytes from the client, and return those due by now.

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
        if not self._begun:  # time begins with the first call
            self._begun = True
            self.motor.begin(now)
            for mode in self.modes:
                if mode.answer_type == self._scanning:
                    self._begin_scan(mode, now)
        self._send_samples(now)
        for command, payload in self._parser.feed(data, now):
            self.requests.append((command, payload))
            if now >= self._booting_until and command not in self.faults.silent:
                self._handle(command, payload, now)
        return self.line.take(now)

    def _send_samples(self, now):
        if self._scan is None:
            return
        if self.faults.stalled or not self.pwm:
            self._scan.wait(now)
        for packet, ready in self._scan.packets(now):
            self.line.put(packet, ready)

    def _handle(self, command, payload, now):
        if command not in NON_INTERRUPTING:
            self._scan = None  # any other request ends a scan
        if command in (Command.SCAN, Command.FORCE_SCAN):
            self._start_scan(self.modes[0], now, force=command == Command.FORCE_SCAN)
        elif command == Command.EXPRESS_SCAN:
            self._express(payload, now)
        elif command == Command.SET_MOTOR_PWM and len(payload) == 2:
            self.motor.turn(min(struct.unpack("<H", payload)[0], 1023), now)
            if self._scan is not None:
                self._scan.wait(self.motor.steady_from)
        elif command == Command.RESET:
            self._reset(now)
        elif (answer := self._answer(command, payload)) is not None:
            kind, body = answer
            self.line.put(Descriptor(len(body), False, kind).pack() + body, now)

    def _answer(self, command, payload):
        """Type and payload of a single response, or None."""
        if command == Command.GET_INFO:
            major, minor = self.firmware
            return AnswerType.INFO, bytes([0x28, minor, major, 5]) + SERIAL
        if command == Command.GET_HEALTH:
            return AnswerType.HEALTH, struct.pack("<BH", *self.health)
        if command == Command.GET_SAMPLERATE and self.firmware >= EXPRESS_SINCE:
            return AnswerType.SAMPLERATE, struct.pack("<HH", 508, 254)
        if command == Command.GET_ACC_BOARD_FLAG:
            return AnswerType.ACC_BOARD_FLAG, struct.pack("<I", 1)
        known = command == Command.GET_LIDAR_CONF and self.firmware >= CONF_SINCE
        value = self._conf(payload) if known and len(payload) >= 4 else None
        return None if value is None else (AnswerType.CONF, payload[:4] + value)

    def _conf(self, payload):
        what, number = (int.from_bytes(payload[a:b], "little") for a, b in ((0, 4), (4, 6)))
        values = {
            Conf.MODE_COUNT: struct.pack("<H", len(self.modes)),
            Conf.TYPICAL_MODE: struct.pack("<H", self.typical),
            Conf.DESIRED_ROTATION: struct.pack("<HH", round(60 * NOMINAL_RATE), NOMINAL_PWM),
        }
        if len(payload) >= 6 and number < len(self.modes):
            mode = self.modes[number]
            values[Conf.US_PER_SAMPLE] = struct.pack("<I", round(mode.period * 1e6 * 256))
            values[Conf.MAX_DISTANCE] = struct.pack("<I", round(mode.range_max * 256))
            values[Conf.ANSWER_TYPE] = bytes([mode.answer_type])
            values[Conf.NAME] = mode.name.encode() + b"\0"
        return values.get(what)

    def _express(self, payload, now):
        if len(payload) != 5 or self.firmware < EXPRESS_SINCE:
            return
        legacy = self.firmware < CONF_SINCE or payload[0] == 0
        number = 1 if legacy else payload[0]  # asked for mode 0 it sends the first capsules
        if number < len(self.modes):
            self._start_scan(self.modes[number], now)

    def _start_scan(self, mode, now, force=False):
        if self.health[0] == PROTECTED:
            return
        kind = mode.answer_type
        self.line.put(Descriptor(PACKET_SIZES[kind], True, kind).pack(), now)
        self._begin_scan(mode, now if force else max(now, self.motor.steady_from))

    def _begin_scan(self, mode, at):
        self._scan = ScanSampler(mode, self.motor, self._measure, at)

    def _reset(self, now):
        self._booting_until = now + BOOT_TIMES[1]
        if self._reset_heals:
            self.health = 0, 0
        self.line.put(BANNER % self.firmware, now + BOOT_TIMES[0])


RplidarMachine = RPLidarEmulator  # name in the first edition
