"""Status frames of eMIR; six of their bytes are signed (the thesis states that all are signed)."""

from dataclasses import dataclass

from slamlab.devices.emir.frames import LENGTHS, STATUS, frame

SIGNED = {7, 8, 9, 10, 14, 15}  # bytes with a sign
CHARGING = 0x80  # bit of the battery's byte


@dataclass(frozen=True)
class Status:
    """Status of the robot that one frame contains, in raw units.

    ``proximity``: infrared distances [cm]; ``speed``, ``rotation``, ``left``, ``right``: rates of
    the robot and its motors [%]; ``azimuth``: heading [2 degrees]; ``path`` [about 1 cm], ``angle``
    [about 2 degrees]: counters modulo 256.
    """

    proximity: tuple[int, ...] = (80,) * 6
    battery: int = 0
    speed: int = 0
    rotation: int = 0
    left: int = 0
    right: int = 0
    mode: int = 0
    inputs: int = 0
    azimuth: int = 0
    path: int = 0
    angle: int = 0

    @classmethod
    def unpack(cls, data):
        """Decode the 16 bytes of a status; the checksum is not included. Raises ValueError."""
        if len(data) != LENGTHS[STATUS] - 1:
            raise ValueError(f"a status must have {LENGTHS[STATUS] - 1} bytes, not {len(data)}")
        values = [b - 256 if i in SIGNED and b > 127 else b for i, b in enumerate(data)]
        return cls(tuple(values[:6]), *values[6:])

    def pack(self):
        rest = self.battery, self.speed, self.rotation, self.left, self.right, self.mode
        end = self.inputs, self.azimuth, self.path, self.angle
        return frame(bytes(v % 256 for v in (*self.proximity, *rest, *end)), STATUS)

    @property
    def volts(self):
        """Battery voltage [V]."""
        return 9 + (self.battery & ~CHARGING) / 17

    @property
    def charging(self):
        return bool(self.battery & CHARGING)
