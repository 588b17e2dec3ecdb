"""Responses of an RPLIDAR: a seven-byte descriptor, then one payload or a stream of packets."""

import struct
from dataclasses import dataclass
from enum import IntEnum

from slamlab.devices.errors import ProtocolError
from slamlab.devices.rplidar.requests import Conf

DESCRIPTOR_SYNC = b"\xa5\x5a"  # first bytes of every descriptor
DESCRIPTOR_SIZE = 7  # bytes
MAX_PAYLOAD = 1024  # bytes; longer payloads do not exist


class AnswerType(IntEnum):
    """Types of responses."""

    INFO = 0x04
    HEALTH = 0x06
    SAMPLERATE = 0x15
    CONF = 0x20
    SCAN = 0x81
    EXPRESS = 0x82
    HQ = 0x83
    ULTRA = 0x84
    DENSE = 0x85
    ULTRA_DENSE = 0x86
    ACC_BOARD_FLAG = 0xFF


@dataclass(frozen=True)
class Descriptor:
    """Response descriptor with packet ``length`` [byte]; ``loop``: whether a stream follows."""

    length: int
    loop: bool
    type: int

    def pack(self):
        return DESCRIPTOR_SYNC + struct.pack("<IB", self.length | self.loop << 30, self.type)

    @classmethod
    def unpack(cls, data):
        """Decode seven bytes; return None if they are not a descriptor."""
        if len(data) != DESCRIPTOR_SIZE or data[:2] != DESCRIPTOR_SYNC:
            return None
        word, kind = struct.unpack("<IB", data[2:])
        if word >> 30 > 1 or not 0 < word & 0x3FFFFFFF <= MAX_PAYLOAD:
            return None
        return cls(word & 0x3FFFFFFF, bool(word >> 30), kind)


# by series: the number before its first model, in the high half of the model byte
SERIES = {"M": 11, "T": 8, "S": 5, "C": 3, "A": 0}
EXPRESS_SINCE, CONF_SINCE = (1, 17), (1, 24)  # first firmware of the A series with these commands


@dataclass(frozen=True)
class Info:
    """Device information; ``firmware`` is (major, minor)."""

    model: int
    firmware: tuple[int, int]
    hardware: int
    serial: str

    @classmethod
    def unpack(cls, payload):
        model, minor, major, hardware = payload[:4]
        return cls(model, (major, minor), hardware, payload[4:].hex().upper())

    @property
    def series(self):
        """Letter of the series: for example, A (triangulation), C or S (time of flight)."""
        return next((name for name, before in SERIES.items() if self.model >> 4 > before), "A")

    @property
    def short_name(self):
        """Short name of the model, such as A2."""
        return f"{self.series}{(self.model >> 4) - SERIES[self.series]}"

    @property
    def name(self):
        """Name of the model and its number, such as RPLIDAR A2 (model 0x28)."""
        return f"RPLIDAR {self.short_name} (model {self.model:#04x})"

    @property
    def has_express(self):
        return self.series != "A" or self.firmware >= EXPRESS_SINCE

    @property
    def has_conf(self):
        """Whether the firmware reports its configuration, such as its scan modes."""
        return self.series != "A" or self.firmware >= CONF_SINCE

    @property
    def controls_motor(self):
        """Whether the lidar has speed control: it gets a rotation rate, not a duty cycle."""
        return self.series not in "AC"


@dataclass(frozen=True)
class Health:
    """Device health; ``status``: 0 good, 1 warning, 2 error (protection stop, without scans)."""

    status: int
    code: int

    @classmethod
    def unpack(cls, payload):
        return cls(*struct.unpack("<BH", payload))

    def __str__(self):
        words = {0: "good", 1: "warning", 2: "error, protection stop"}
        return f"{words.get(self.status, f'status {self.status}')} (code 0x{self.code:04X})"


@dataclass(frozen=True)
class SampleRate:
    """Sample periods [s] in the standard mode and in the express mode."""

    standard: float
    express: float

    @classmethod
    def unpack(cls, payload):
        """Decode 4 bytes that contain both periods in microseconds."""
        standard, express = struct.unpack("<HH", payload)
        return cls(standard * 1e-6, express * 1e-6)


def conf_value(what, payload):
    """Decode the value in a response to a Conf request: an int, a float [µs or m] or a str.

    Raises ProtocolError.
    """
    value = payload[4:]
    try:
        if int.from_bytes(payload[:4], "little") != what:
            raise ValueError("the response belongs to another request")
        if what == Conf.NAME:
            return value.split(b"\0", 1)[0].decode("ascii", "replace")
        if what in (Conf.US_PER_SAMPLE, Conf.MAX_DISTANCE):
            return struct.unpack("<I", value)[0] / 256
        if what == Conf.ANSWER_TYPE:
            return struct.unpack("<B", value[:1])[0]
        return struct.unpack("<H", value[:2])[0]
    except (ValueError, struct.error) as error:
        raise ProtocolError(
            f"the response to configuration request 0x{what:02X} is malformed ({payload.hex()})",
            f"bytes were lost on the line ({error})",
            "close the connection, unplug and reconnect the lidar, and try again",
        ) from error


class ResponseFinder:
    """Finds a response in a stream that may also contain old scan data, boot text and errors.

    ``type``: one or several expected AnswerTypes; ``loop``: whether a stream is expected;
    ``length``: length of the payload, or None; ``others``: skipped descriptors; ``rest``: bytes
    after the response.
    """

    def __init__(self, type, loop=False, length=None):
        self._types = {type} if isinstance(type, int) else set(type)
        self._loop, self._length = loop, length
        self._buffer = b""
        self.others, self.rest = [], b""

    def feed(self, data):
        """Parse bytes and return (Descriptor, payload) of a complete response, or None."""
        self._buffer += data
        found = self._next()
        if found is not None:
            self.rest, self._buffer = self._buffer, b""
        return found

    def _fits(self, descriptor):
        length_fits = self._length in (None, descriptor.length)
        return descriptor.type in self._types and descriptor.loop == self._loop and length_fits

    def _next(self):
        while (at := self._buffer.find(DESCRIPTOR_SYNC)) >= 0:
            descriptor = Descriptor.unpack(self._buffer[at : at + DESCRIPTOR_SIZE])
            if descriptor is None and len(self._buffer) - at >= DESCRIPTOR_SIZE:
                self._buffer = self._buffer[at + 1 :]
                continue
            self._buffer = self._buffer[at:]
            if descriptor is None:
                return None
            if not self._fits(descriptor):  # a false match: the expected one may begin inside it
                self.others = [*self.others[-9:], descriptor]
                self._buffer = self._buffer[len(DESCRIPTOR_SYNC) :]
                continue
            end = DESCRIPTOR_SIZE + (0 if descriptor.loop else descriptor.length)
            if len(self._buffer) < end:
                return None
            payload, self._buffer = self._buffer[DESCRIPTOR_SIZE:end], self._buffer[end:]
            return descriptor, payload
        half = self._buffer.endswith(DESCRIPTOR_SYNC[:1])
        self._buffer = DESCRIPTOR_SYNC[:1] if half else b""
        return None
