"""Responses of an RPLIDAR: a descriptor of seven bytes, then its payload once or without end."""

import struct
from dataclasses import dataclass
from enum import IntEnum

from slamlab.devices.errors import ProtocolError
from slamlab.devices.rplidar.requests import Conf

DESCRIPTOR_SYNC = b"\xa5\x5a"  # first bytes of every descriptor
DESCRIPTOR_SIZE = 7  # bytes
MAX_PAYLOAD = 1024  # bytes; a longer one is none


class AnswerType(IntEnum):
    """Response (answer) types, as a descriptor names them."""

    INFO = 0x04
    HEALTH = 0x06
    SAMPLERATE = 0x15
    CONF = 0x20
    SCAN = 0x81
    EXPRESS = 0x82
    ULTRA = 0x84
    DENSE = 0x85
    ACC_BOARD_FLAG = 0xFF


@dataclass(frozen=True)
class Descriptor:
    """Response descriptor: packets of ``length`` bytes and a ``type``, one or (``loop``) many."""

    length: int
    loop: bool
    type: int

    def pack(self):
        """Encode the descriptor in its seven bytes."""
        return DESCRIPTOR_SYNC + struct.pack("<IB", self.length | self.loop << 30, self.type)

    @classmethod
    def unpack(cls, data):
        """Decode a descriptor from its seven bytes; None where they are none."""
        if len(data) != DESCRIPTOR_SIZE or data[:2] != DESCRIPTOR_SYNC:
            return None
        word, kind = struct.unpack("<IB", data[2:])
        if word >> 30 > 1 or not 0 < word & 0x3FFFFFFF <= MAX_PAYLOAD:
            return None
        return cls(word & 0x3FFFFFFF, bool(word >> 30), kind)


@dataclass(frozen=True)
class Info:
    """Device information; ``firmware`` is (major, minor), ``serial`` number in the wire's order."""

    model: int
    firmware: tuple[int, int]
    hardware: int
    serial: str

    @classmethod
    def unpack(cls, payload):
        """Decode 20 bytes."""
        model, minor, major, hardware = payload[:4]
        return cls(model, (major, minor), hardware, payload[4:].hex().upper())

    @property
    def name(self):
        """Model name, str such as RPLIDAR A2, with its number."""
        return f"RPLIDAR A{self.model >> 4} (model {self.model:#04x})"


@dataclass(frozen=True)
class Health:
    """Device health: ``status`` 0 good, 1 warning, 2 it protects itself and does not scan."""

    status: int
    code: int

    @classmethod
    def unpack(cls, payload):
        """Decode 3 bytes; the error code is little endian as everything here."""
        return cls(*struct.unpack("<BH", payload))

    def __str__(self):
        words = {0: "good", 1: "warning", 2: "error, it has stopped to protect itself"}
        return f"{words.get(self.status, f'status {self.status}')} (code 0x{self.code:04X})"


@dataclass(frozen=True)
class SampleRate:
    """Sample period (time between samples) [s], in the standard and the express mode."""

    standard: float
    express: float

    @classmethod
    def unpack(cls, payload):
        """Decode 4 bytes, in microseconds."""
        standard, express = struct.unpack("<HH", payload)
        return cls(standard * 1e-6, express * 1e-6)


def conf_value(what, payload):
    """Decode the response to a configuration request.

    Parameters
    ----------
    what : Conf that was asked for; the answer repeats it
    payload : bytes

    Returns
    -------
    int, float (US_PER_SAMPLE [µs], MAX_DISTANCE [m]) or str (NAME)

    Raises
    ------
    ProtocolError : an answer to another question, or of another size
    """
    value = payload[4:]
    try:
        if int.from_bytes(payload[:4], "little") != what:
            raise ValueError("it answers another question")
        if what == Conf.NAME:
            return value.split(b"\0", 1)[0].decode("ascii", "replace")
        if what in (Conf.US_PER_SAMPLE, Conf.MAX_DISTANCE):
            return struct.unpack("<I", value)[0] / 256
        if what == Conf.ANSWER_TYPE:
            return struct.unpack("<B", value[:1])[0]
        return struct.unpack("<H", value[:2])[0]
    except (ValueError, struct.error) as error:
        raise ProtocolError(
            f"the lidar's answer to configuration 0x{what:02X} makes no sense ({payload.hex()})",
            f"bytes were lost on the line: {error}",
            "close the lidar, plug it in anew and try again",
        ) from error
