"""Requests to an RPLIDAR: framing, XOR checksum, parser.

A request consists of A5 and a command. If the command's top bit is set, the payload's length, the
payload and a checksum follow. All numbers are little endian. Source: Slamtec's protocol document.
"""

import struct
from enum import IntEnum
from functools import reduce
from operator import xor

SYNC = 0xA5  # first byte of every request
WITH_PAYLOAD = 0x80  # bit of a command with a payload
NOMINAL_PWM, NOMINAL_RPM = 660, 600  # duty cycle, and the rotation rate at it [1/min]
PARTIAL_TIMEOUT = 5.0  # after which the parser drops an incomplete request [s]


class Command(IntEnum):
    """Command codes."""

    EXPRESS_SCAN = 0x82
    FORCE_SCAN = 0x21
    GET_ACC_BOARD_FLAG = 0xFF
    GET_HEALTH = 0x52
    GET_INFO = 0x50
    GET_LIDAR_CONF = 0x84
    GET_SAMPLERATE = 0x59
    MOTOR_SPEED = 0xA8
    RESET = 0x40
    SCAN = 0x20
    SET_MOTOR_PWM = 0xF0
    STOP = 0x25


SCAN_COMMANDS = {Command.SCAN, Command.FORCE_SCAN, Command.EXPRESS_SCAN}  # start a scan
MOTOR_COMMANDS = {Command.SET_MOTOR_PWM, Command.MOTOR_SPEED}  # without a response
# requests that do not interrupt a scan; any other request ends it
NON_INTERRUPTING = MOTOR_COMMANDS | {Command.GET_ACC_BOARD_FLAG}


class Conf(IntEnum):
    """Keys of GET_LIDAR_CONF. The keys from US_PER_SAMPLE refer to one scan mode."""

    DESIRED_ROTATION = 0x01
    MODE_COUNT = 0x70
    TYPICAL_MODE = 0x7C
    US_PER_SAMPLE = 0x71
    MAX_DISTANCE = 0x74
    ANSWER_TYPE = 0x75
    NAME = 0x7F


def checksum(data):
    """Return the XOR checksum of all bytes."""
    return reduce(xor, data, 0)


def request(command, payload=b""):
    """Encode a request with a payload of at most 255 bytes. Raises ValueError."""
    if not command & WITH_PAYLOAD:
        if payload:
            raise ValueError(f"command 0x{command:02X} must not have a payload")
        return bytes([SYNC, command])
    if len(payload) > 255:
        raise ValueError(f"a payload must have at most 255 bytes, not {len(payload)}")
    body = bytes([SYNC, command, len(payload)]) + payload
    return body + bytes([checksum(body)])


def express(mode):
    """Encode EXPRESS_SCAN with a scan mode; firmware without scan modes needs mode 0."""
    return request(Command.EXPRESS_SCAN, struct.pack("<BHH", mode, 0, 0))


def motor_pwm(pwm):
    """Encode the PWM duty cycle for a motor, 0 to 1023; 660 is about 10 Hz. Raises ValueError."""
    if not 0 <= pwm <= 1023:
        raise ValueError(f"the PWM duty cycle of the motor must be from 0 to 1023, not {pwm}")
    return request(Command.SET_MOTOR_PWM, struct.pack("<H", pwm))


def motor_speed(rpm):
    """Encode a rotation rate [1/min] for a lidar with speed control; 0 stops the motor."""
    return request(Command.MOTOR_SPEED, struct.pack("<H", rpm))


def conf(what, mode=None):
    """Encode a request for the Conf value of a scan mode or of the whole lidar."""
    payload = struct.pack("<I", what) if mode is None else struct.pack("<IH", what, mode)
    return request(Command.GET_LIDAR_CONF, payload)


class RequestParser:
    """Parser that finds requests in a byte stream and verifies their checksum."""

    def __init__(self):
        self._buffer, self._since = b"", 0.0

    def feed(self, data, now):
        """Parse bytes received at a given time [s]; return complete requests (command, payload)."""
        if self._buffer and now - self._since > PARTIAL_TIMEOUT:
            self._buffer = b""
        if data and not self._buffer:
            self._since = now
        self._buffer += data
        found = []
        while (request := self._next()) is not None:
            found.append(request)
            self._since = now
        return found

    def _next(self):
        while True:
            self._buffer = self._buffer[self._buffer.find(SYNC) :] if SYNC in self._buffer else b""
            if len(self._buffer) < 2:
                return None
            command = self._buffer[1]
            if not command & WITH_PAYLOAD:
                self._buffer = self._buffer[2:]
                if command != SYNC:
                    return command, b""
                continue
            if len(self._buffer) < 3:
                return None
            end = 4 + self._buffer[2]
            if len(self._buffer) < end:
                return None
            whole, self._buffer = self._buffer[:end], self._buffer[end:]
            if checksum(whole[:-1]) == whole[-1]:
                return command, whole[3:-1]
