"""RPLIDAR emulator: state machine for the device's side of the protocol."""

import errno
import struct

import numpy as np

from slamlab.devices.emulator.lidar_models import MODELS
from slamlab.devices.emulator.scan_sampling import Motor, ScanSampler
from slamlab.devices.emulator.serial_line import Faults, SerialLine
from slamlab.devices.rplidar.requests import (
    MOTOR_COMMANDS,
    NOMINAL_PWM,
    NOMINAL_RPM,
    NON_INTERRUPTING,
    Command,
    Conf,
    RequestParser,
)
from slamlab.devices.rplidar.responses import AnswerType, Descriptor, Info
from slamlab.devices.rplidar.scan_stream import DECODERS

BANNER = b"RP LIDAR System.\r\nFirmware Ver %d.%d, HW Ver 5\r\nModel: 28\r\n"
BOOT_TIMES = 0.02, 0.3  # from a RESET to the boot banner, and to the first request served [s]
SERIAL = bytes.fromhex("ABB69AF2C1EA9FC2A2EB92F138653C00")  # reported serial number
PROTECTION_STOP = 2  # health status in which the device does not scan
UNKNOWN_TYPE, UNKNOWN_SIZE = 0x99, 60  # of data of an unknown type


class RPLidarEmulator:
    """Emulated RPLIDAR with the timing and bandwidth of the real device.

    ``measure``: callable(times (n,) [s], directions (n,) clockwise [degree]) -> (n,) [mm], 0 for no
    return; ``model``: LidarModel; ``firmware``, ``modes``, ``typical``, ``baud``: values instead of
    the model's values; ``scanning``: AnswerType of a scan that runs from the start, or None. The A
    series reports no configuration before ``firmware`` (1, 24). At another baud rate, all bytes
    from the device are corrupted.
    """

    def __init__(
        self,
        measure,
        model=MODELS["a2m8"],
        firmware=None,
        modes=None,
        typical=None,
        health=(0, 0),
        reset_heals=True,
        spinning=True,
        scanning=None,
        spin_up=0.5,
        faults=None,
        baud=None,
        rng=None,
    ):
        self._measure, self.firmware = measure, firmware or model.firmware
        self.modes = modes or model.modes
        self.typical = model.typical if typical is None else typical
        self.info = Info(model.number, self.firmware, model.hardware, SERIAL.hex())
        scans = [
            mode for mode in (*self.modes, *model.modes) if mode.answer_type == AnswerType.SCAN
        ]
        self._standard, self.baud = scans[0], baud or model.baud
        self.health, self._reset_heals = health, reset_heals
        self.faults = faults or Faults()
        rng = rng or np.random.default_rng(0)
        self.line = SerialLine(self.baud, self.faults, rng)
        pwm = NOMINAL_PWM if spinning else 0
        self.motor = Motor(pwm, spin_up, rng.uniform(0, 360), model.scanner.rate)
        self._parser, self._scan, self._booting_until = RequestParser(), None, -np.inf
        self._scanning, self._begun = scanning, False
        self.requests = []

    @property
    def pwm(self):
        """PWM duty cycle of the motor, 0 to 1023."""
        return self.motor.pwm

    def feed(self, data, now):
        """Receive bytes at ``now`` [s] and return bytes to send. Raises OSError when unplugged."""
        if self.faults.unplugged:
            raise OSError(errno.EIO, "Input/output error")
        if not self._begun:  # the first call sets the start time
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
            self._start_scan(self._standard, now, force=command == Command.FORCE_SCAN)
        elif command == Command.EXPRESS_SCAN:
            self._express(payload, now)
        elif command in MOTOR_COMMANDS and len(payload) == 2:
            self._set_motor(command, *struct.unpack("<H", payload), now)
        elif command == Command.RESET:
            self._reset(now)
        elif (answer := self._answer(command, payload)) is not None:
            kind, body = answer
            self.line.put(Descriptor(len(body), False, kind).pack() + body, now)

    def _answer(self, command, payload):
        """Return the type and the payload of a single response, or None if there is none."""
        if command == Command.GET_INFO:
            model, (major, minor), hardware = self.info.model, self.firmware, self.info.hardware
            return AnswerType.INFO, bytes([model, minor, major, hardware]) + SERIAL
        if command == Command.GET_HEALTH:
            return AnswerType.HEALTH, struct.pack("<BH", *self.health)
        if command == Command.GET_SAMPLERATE and self.info.has_express:
            standard = round(self._standard.period * 1e6)
            return AnswerType.SAMPLERATE, struct.pack("<HH", standard, standard // 2)
        if command == Command.GET_ACC_BOARD_FLAG:
            return AnswerType.ACC_BOARD_FLAG, struct.pack("<I", 1)
        known = command == Command.GET_LIDAR_CONF and self.info.has_conf
        value = self._conf(payload) if known and len(payload) >= 4 else None
        return None if value is None else (AnswerType.CONF, payload[:4] + value)

    def _conf(self, payload):
        what, number = (int.from_bytes(payload[a:b], "little") for a, b in ((0, 4), (4, 6)))
        values = {
            Conf.MODE_COUNT: struct.pack("<H", len(self.modes)),
            Conf.TYPICAL_MODE: struct.pack("<H", self.typical),
            Conf.DESIRED_ROTATION: struct.pack("<HH", NOMINAL_RPM, NOMINAL_PWM),
        }
        if len(payload) >= 6 and number < len(self.modes):
            mode = self.modes[number]
            values[Conf.US_PER_SAMPLE] = struct.pack("<I", round(mode.period * 1e6 * 256))
            values[Conf.MAX_DISTANCE] = struct.pack("<I", round(mode.range_max * 256))
            values[Conf.ANSWER_TYPE] = bytes([self._type(mode)])
            values[Conf.NAME] = mode.name.encode() + b"\0"
        return values.get(what)

    def _express(self, payload, now):
        if len(payload) != 5 or not self.info.has_express:
            return
        legacy = not self.info.has_conf or self.modes[payload[0] :][:1] == (self._standard,)
        number = 1 if legacy else payload[0]  # mode 0 requests the legacy express mode
        if number < len(self.modes):
            self._start_scan(self.modes[number], now)

    def _start_scan(self, mode, now, force=False):
        if self.health[0] == PROTECTION_STOP:
            return
        kind = self._type(mode)
        size = DECODERS[kind].size if kind in DECODERS else UNKNOWN_SIZE
        self.line.put(Descriptor(size, True, kind).pack(), now)
        self._begin_scan(mode, now if force else max(now, self.motor.steady_from))

    def _begin_scan(self, mode, at):
        self._scan = ScanSampler(mode, self._type(mode), self.motor, self._measured, at)

    def _type(self, mode):
        """Return the answer type of a mode; during the fault ``unknown_type``, an unknown type."""
        standard = mode.answer_type == AnswerType.SCAN
        return UNKNOWN_TYPE if self.faults.unknown_type and not standard else mode.answer_type

    def _measured(self, times, directions):
        distances = self._measure(times, directions)
        return np.zeros_like(distances) if self.faults.blind else distances

    def _set_motor(self, command, value, now):
        by_rate = command == Command.MOTOR_SPEED
        if by_rate != self.info.controls_motor:
            return
        pwm = value * NOMINAL_PWM / NOMINAL_RPM if by_rate else min(value, 1023)
        self.motor.set_pwm(pwm, now)
        if self._scan is not None:
            self._scan.wait(self.motor.steady_from)

    def _reset(self, now):
        self._booting_until = now + BOOT_TIMES[1]
        if self._reset_heals:
            self.health = 0, 0
        self.line.put(BANNER % self.firmware, now + BOOT_TIMES[0])
