"""Requests (commands) to an RPLIDAR: A5, command; where its top bit is set, payload, checksum.

Slamtec's protocol document; all numbers are little endian.
"""

import struct
from enum import IntEnum
from functools import reduce
from operator import xor

SYNC = 0xA5  # first byte of every request
WITH_PAYLOAD = 0x80  # bit of a command that has a payload


class Command(IntEnum):
    """Command codes of the A series."""

    EXPRESS_SCAN = 0x82
    FORCE_SCAN = 0x21
    GET_ACC_BOARD_FLAG = 0xFF
    GET_HEALTH = 0x52
    GET_INFO = 0x50
    GET_LIDAR_CONF = 0x84
    GET_SAMPLERATE = 0x59
    RESET = 0x40
    SCAN = 0x20
    SET_MOTOR_PWM = 0xF0
    STOP = 0x25


SCAN_COMMANDS = {Command.SCAN, Command.FORCE_SCAN, Command.EXPRESS_SCAN}  # start a scan
NON_INTERRUPTING = {Command.SET_MOTOR_PWM, Command.GET_ACC_BOARD_FLAG}
"""Requests that do not interrupt a scan; any other ends it."""


class Conf(IntEnum):
    """Configuration keys of GET_LIDAR_CONF; those from US_PER_SAMPLE on belong to one scan mode."""

    DESIRED_ROTATION = 0x01
    MODE_COUNT = 0x70
    TYPICAL_MODE = 0x7C
    US_PER_SAMPLE = 0x71
    MAX_DISTANCE = 0x74
    ANSWER_TYPE = 0x75
    NAME = 0x7F


def checksum(data):
    """Checksum of a request: all bytes XORed.

    Parameters
    ----------
    data : bytes

    Returns
    -------
    int
    """
    return reduce(xor, data, 0)


def request(command, payload=b""):
    """Encode a request, with payload and checksum, as it goes over the line.

    Parameters
    ----------
    command : Command
    payload : bytes, at most 255; only commands from 0x80 on have one

    Returns
    -------
    bytes

    Raises
    ------
    ValueError
    """
    if not command & WITH_PAYLOAD:
        if payload:
            raise ValueError(f"command 0x{command:02X} takes no payload")
        return bytes([SYNC, command])
    if len(payload) > 255:
        raise ValueError(f"a payload has at most 255 bytes, not {len(payload)}")
    body = bytes([SYNC, command, len(payload)]) + payload
    return body + bytes([checksum(body)])


def express(mode):
    """Request of an express scan: a mode other than the standard one.

    Parameters
    ----------
    mode : int, its number; 0 for firmware that knows no modes

    Returns
    -------
    bytes
    """
    return request(Command.EXPRESS_SCAN, struct.pack("<BHH", mode, 0, 0))


def motor_pwm(pwm):
    """Request that sets the motor's PWM (duty cycle), and with it the scan rate.

    Parameters
    ----------
    pwm : int, 0 (stands) to 1023; 660 is about 10 turns a second

    Returns
    -------
    bytes

    Raises
    ------
    ValueError
    """
    if not 0 <= pwm <= 1023:
        raise ValueError(f"the motor takes 0 to 1023, not {pwm}")
    return request(Command.SET_MOTOR_PWM, struct.pack("<H", pwm))


def conf(what, mode=None):
    """Request for one value of the lidar's configuration.

    Parameters
    ----------
    what : Conf
    mode : int, or None for values that belong to no mode

    Returns
    -------
    bytes
    """
    payload = struct.pack("<I", what) if mode is None else struct.pack("<IH", what, mode)
    return request(Command.GET_LIDAR_CONF, payload)
