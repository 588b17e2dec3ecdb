"""Measurement nodes (samples: angle, distance, quality) and the decoder of the standard scan.

A decoder knows no port and no time: bytes in, nodes out. However the bytes are cut, the same nodes
come; damage is counted and never an exception.
"""

from collections import Counter

import numpy as np

TURN_Q6 = 360 * 64  # a revolution in the unit of a node's angle [1/64 degree]
NODE_DTYPE = np.dtype(
    [
        ("angle_q6", "<i4"),  # clockwise from the sensor's front [1/64 degree]
        ("distance_q2", "<i4"),  # [1/4 mm]; 0: nothing came back
        ("quality", "u1"),
        ("start", "?"),  # a turn begins here
        ("after_gap", "?"),  # something was lost before this one
    ]
)
BLOCK_SIZE = 1024  # bytes decoded at a time: the work stays linear
NO_NODES = np.empty(0, NODE_DTYPE)  # result where no packet is complete
NO_ANGLES = np.array([-1, -2, -3])  # angles that no node has


class Decoder:
    """Base class of the stream decoders: bytes in, measurement nodes out, resynchronising.

    ``size`` is a packet's length in bytes, ``late`` how many samples after the last node that it
    returned a decoder is given the packet that completed it. ``damage`` counts ``resyncs``,
    ``bytes dropped`` and ``bad checksums``; ``received`` counts bytes.
    """

    size, delay = 0, 0

    def __init__(self):
        self.damage: Counter[str] = Counter()
        self.received = 0
        self._buffer = b""

    @property
    def pending(self):
        """Number of bytes received of a packet that is not complete."""
        return len(self._buffer)

    def feed(self, data):
        """Decode bytes as they come.

        Parameters
        ----------
        data : bytes

        Returns
        -------
        (n,) array of NODE_DTYPE, those that became complete
        """
        self.received += len(data)
        found = []
        for at in range(0, len(data), BLOCK_SIZE):
            self._buffer += data[at : at + BLOCK_SIZE]
            found += self._decode()
        if len(found) == 1:
            return found[0]
        return np.concatenate(found) if found else NO_NODES

    def _decode(self):
        """Yield arrays of nodes from the buffer and shorten it."""
        raise NotImplementedError

    def _drop(self, n):
        self.damage["bytes dropped"] += n
        self._buffer = self._buffer[n:]


class ScanDecoder(Decoder):
    """Decoder of SCAN and FORCE_SCAN: nodes of five bytes, resynchronised after lost bytes.

    Equations (14.1) and (14.2).

    The first byte holds S, not S and quality, the next two C = 1 and the angle, the last two the
    distance. A quarter of all random bytes passes those check bits, so that synchronisation once
    lost is found again only where RUN nodes in a row fit and their angles advance a little; and
    where RUN angles in a row are the same, equal distances are being read as nodes: it is lost.
    """

    size = 5
    RUN = 4
    WINDOW = RUN * size  # bytes that decide whether it is in sync
    BACK, AHEAD = 5 * 64, 30 * 64  # how far an angle goes to the next node's [1/64 degree]

    def __init__(self):
        super().__init__()
        self._in_sync, self._gap = True, False
        self._last_angles = NO_ANGLES

    def _decode(self):
        while len(self._buffer) >= (self.size if self._in_sync else self.WINDOW):
            if self._in_sync:
                yield self._decode_in_sync()
            else:
                self._resynchronise()

    def _decode_in_sync(self):
        """Decode nodes up to the first that fails its check bits."""
        rows = np.frombuffer(self._buffer, np.uint8, len(self._buffer) // 5 * 5).reshape(-1, 5)
        flags, angle = rows[:, 0], _u16(rows[:, 1], rows[:, 2])
        bad = np.flatnonzero(~_plausible(flags, angle) | self._repeated_angle(angle))
        n = int(bad[0]) if len(bad) else len(rows)
        nodes = np.empty(n, NODE_DTYPE)
        nodes["angle_q6"] = angle[:n] >> 1
        nodes["distance_q2"] = _u16(rows[:n, 3], rows[:n, 4])
        nodes["quality"] = flags[:n] >> 2
        nodes["start"] = flags[:n] & 1
        nodes["after_gap"] = False
        if n:
            nodes["after_gap"][0], self._gap = self._gap, False
        self._buffer = self._buffer[5 * n :]
        if len(bad):
            self._in_sync, self._gap, self._last_angles = False, True, NO_ANGLES
            self.damage["resyncs"] += 1
            self._drop(1)
        return nodes

    def _repeated_angle(self, angle):
        """Where the angle is that of the three nodes before: (n,) bool."""
        run = np.concatenate([self._last_angles, angle])
        self._last_angles = run[1 - self.RUN :]
        return (run[3:] == run[2:-1]) & (run[3:] == run[1:-2]) & (run[3:] == run[:-3])

    def _resynchronise(self):
        """Drop bytes up to where nodes are in sync again, or as far as can be decided."""
        raw = np.frombuffer(self._buffer, np.uint8)
        places = len(raw) - self.WINDOW + 1
        angle = _u16(raw[1:-1], raw[2:])
        fits, angle = _plausible(raw[:-2], angle), angle >> 1
        found = np.ones(places, bool)
        advance = np.zeros(places, np.int32)
        for k in range(self.RUN):
            found &= fits[5 * k : 5 * k + places]
            if k:
                step = angle[5 * k :][:places] - angle[5 * k - 5 :][:places]
                step = (step + self.BACK) % TURN_Q6 - self.BACK
                found &= step < self.AHEAD
                advance += step
        hits = np.flatnonzero(found & (advance > 0))
        self._in_sync = len(hits) > 0
        self._drop(int(hits[0]) if len(hits) else places)


def _u16(low, high):
    return low.astype(np.int32) | high.astype(np.int32) << 8


def _plausible(flags, angle):
    """Check bits of nodes: S differs from not S, C is one, and the angle is less than a turn."""
    return ((flags ^ flags >> 1) & 1 == 1) & (angle & 1 == 1) & (angle >> 1 < TURN_Q6)
