"""Status frames of eMIR: sensors, battery, counters; six bytes are signed (the thesis: all)."""

from dataclasses import dataclass

from slamlab.devices.emir.frames import LENGTHS, STATUS, frame

SIGNED = {7, 8, 9, 10, 14, 15}  # bytes with a sign
CHARGING = 0x80  # bit of the battery's byte


@dataclass(frozen=True)
class Status:
    """Status of the robot as one frame tells it, numbers as they came.

    Parameters
    ----------
    proximity : six int, infrared distances [cm]
    battery : int, see :attr:`volts` and :attr:`charging`
    speed, rotation : int, what the robot does [%]
    left, right : int, of the motors [%]
    mode : int
    inputs : int, digital inputs, a bit each
    azimuth : int, compass [2 degrees]
    path : int, since the last reset, modulo 256 [about 1 cm]
    angle : int, since the last reset, modulo 256 [about 2 degrees]
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
        """Decode a status frame's 16 bytes, the checksum taken off.

        Raises
        ------
        ValueError
        """
        if len(data) != LENGTHS[STATUS] - 1:
            raise ValueError(f"a status has {LENGTHS[STATUS] - 1} bytes, not {len(data)}")
        values = [b - 256 if i in SIGNED and b > 127 else b for i, b in enumerate(data)]
        return cls(tuple(values[:6]), *values[6:])

    def pack(self):
        """Encode the status as a frame.

        Returns
        -------
        bytes
        """
        rest = self.battery, self.speed, self.rotation, self.left, self.right, self.mode
        end = self.inputs, self.azimuth, self.path, self.angle
        return frame(bytes(v % 256 for v in (*self.proximity, *rest, *end)), STATUS)

    @property
    def volts(self):
        """Battery voltage [V], float."""
        return 9 + (self.battery & ~CHARGING) / 17

    @property
    def charging(self):
        """Whether the battery is charging, bool."""
        return bool(self.battery & CHARGING)
