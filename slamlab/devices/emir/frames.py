"""Framing of eMIR's protocol: bytes as hexadecimal digits between two marks, with a checksum.

To the robot ``#OOAABBCC/``: opcode, two arguments, checksum; from it ``*``, 17 bytes, ``/``. All
bytes of a frame, its checksum too, add up to 0 modulo 256.
"""

import re
from collections import Counter

COMMAND, STATUS = b"#", b"*"  # start marks
LENGTHS = {COMMAND: 4, STATUS: 17}  # bytes, the checksum included
END = b"/"  # end mark


def checksum(data):
    """Checksum of a frame, the byte that makes the sum 0: (−Σ) mod 256.

    Equation (14.6).

    Parameters
    ----------
    data : bytes

    Returns
    -------
    int
    """
    return -sum(data) % 256


def frame(data, mark=COMMAND):
    """Encode bytes as a frame, with marks and checksum.

    Parameters
    ----------
    data : bytes
    mark : bytes, COMMAND or STATUS

    Returns
    -------
    bytes
    """
    return mark + (data + bytes([checksum(data)])).hex().upper().encode() + END


class Framer:
    """Framer: finds frames in a byte stream and checks their checksum; any cut gives the same.

    Parameters
    ----------
    mark : bytes, COMMAND or STATUS

    ``damage`` counts ``bad frames`` and ``bytes dropped``.
    """

    def __init__(self, mark=STATUS):
        digits = 2 * LENGTHS[mark]
        self._mark, self._size = mark, digits + 2
        self._whole = re.compile(re.escape(mark) + rb"([0-9A-Fa-f]{%d})/" % digits)
        self._buffer = b""
        self.damage: Counter[str] = Counter()

    def feed(self, data):
        """Search bytes as they come.

        Parameters
        ----------
        data : bytes

        Returns
        -------
        list of bytes, a frame's each, without its checksum
        """
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
                at += 1  # a good one may begin within
            else:
                found.append(content[:-1])
                at += self._size
