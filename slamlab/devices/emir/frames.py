"""Framing of eMIR's protocol: hexadecimal digits between a start and an end mark, with a checksum.

A frame to the robot is ``#OOAABBCC/``: opcode, two arguments and checksum. A frame from the robot
is ``*``, 17 bytes and ``/``.
"""

import re
from collections import Counter

COMMAND, STATUS = b"#", b"*"  # start marks
LENGTHS = {COMMAND: 4, STATUS: 17}  # bytes, the checksum included
END = b"/"  # end mark


def checksum(data):
    """Return the checksum −Σ mod 256, so that a frame's sum is 0 mod 256. Equation (14.6)."""
    return -sum(data) % 256


def frame(data, mark=COMMAND):
    """Encode a frame with start mark, data, checksum and end mark."""
    return mark + (data + bytes([checksum(data)])).hex().upper().encode() + END


class Framer:
    """Framer: finds frames in a byte stream, verifies their checksums and counts ``damage``."""

    def __init__(self, mark=STATUS):
        digits = 2 * LENGTHS[mark]
        self._mark, self._size = mark, digits + 2
        self._whole = re.compile(re.escape(mark) + rb"([0-9A-Fa-f]{%d})/" % digits)
        self._buffer = b""
        self.damage: Counter[str] = Counter()

    def feed(self, data):
        """Parse bytes; return the data, without the checksum, of each complete and valid frame."""
        self._buffer += data
        found, at = [], 0
        while True:
            mark = self._buffer.find(self._mark, at)
            dropped = (len(self._buffer) if mark < 0 else mark) - at
            self.damage["bytes dropped"] += dropped
            at += dropped
            if mark < 0 or len(self._buffer) - at < self._size:
                self._buffer = self._buffer[at:]
                return found
            whole = self._whole.match(self._buffer, at)
            content = bytes.fromhex(whole[1].decode()) if whole else b"\x01"
            if sum(content) % 256:
                self.damage["bad frames"] += 1
                self.damage["bytes dropped"] += 1
                at += 1  # resynchronise: a valid frame may begin inside it
            else:
                found.append(content[:-1])
                at += self._size
