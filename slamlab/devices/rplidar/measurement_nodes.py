"""Measurement nodes (angle, distance, quality) and the decoder of the standard scan.

The decoded nodes do not depend on how many bytes each read returns. Decoders count corrupted
bytes and continue by resynchronising; they raise no exception.
"""

from collections import Counter

import numpy as np

TURN_Q6 = 360 * 64  # a revolution in the unit of a node's angle [1/64 degree]
NODE_DTYPE = np.dtype(
    [
        ("angle_q6", "<i4"),  # clockwise from the sensor's front [1/64 degree]
        ("distance_q2", "<i4"),  # [1/4 mm]; 0: no return
        ("quality", "u1"),
        ("start", "?"),  # start flag: a revolution begins here
        ("after_gap", "?"),  # bytes were lost before this node
    ]
)
BLOCK_SIZE = 1024  # bytes decoded at a time: the run time stays linear
NO_NODES = np.empty(0, NODE_DTYPE)  # result where no packet is complete
NO_ANGLES = np.array([-1, -2, -3])  # angles that no node has
CAPSULE_MARKS = (0xF0, 0xA0), (0xF0, 0x50)  # sync pattern of a capsule: mask, value of each byte


class Decoder:
    """Base class of decoders from byte streams to measurement nodes, with resynchronisation.

    ``size``: packet size [byte]; ``delay``: number of samples from the last returned node to
    the end of its packet.
    """

    size, delay = 0, 0

    def __init__(self):
        self.damage: Counter[str] = Counter()
        self.received = 0
        self._buffer = b""

    @property
    def pending(self):
        """Number of bytes received so far of an incomplete packet."""
        return len(self._buffer)

    def feed(self, data):
        """Decode bytes and return the complete nodes (n,), an array of NODE_DTYPE."""
        self.received += len(data)
        found = []
        for at in range(0, len(data), BLOCK_SIZE):
            self._buffer += data[at : at + BLOCK_SIZE]
            found += self._decode()
        if len(found) == 1:
            return found[0]
        return np.concatenate(found) if found else NO_NODES

    def _decode(self):
        """Yield arrays of nodes, and remove the decoded bytes from the buffer."""
        raise NotImplementedError

    def _drop(self, n):
        self.damage["bytes dropped"] += n
        self._buffer = self._buffer[n:]


class PacketDecoder(Decoder):
    """Base class of packet decoders, with framing by sync pattern and checksum verification.

    A packet has ``points`` samples and begins with ``marks`` (mask, value).
    """

    points, marks = 0, CAPSULE_MARKS

    def __init__(self):
        super().__init__()
        self._in_sync, self._gap = True, False

    def _next_packet(self):
        while self._buffer:
            # a single byte is checked as well, so that the counts do not depend on the reads
            if all(b & mask == v for b, (mask, v) in zip(self._buffer, self.marks, strict=False)):
                if len(self._buffer) < self.size:
                    return None
                packet = self._buffer[: self.size]
                if self._checksum_is_valid(packet):
                    self._buffer = self._buffer[self.size :]
                    self._in_sync = True
                    return packet
                self.damage["bad checksums"] += 1
            self._resynchronise()
        return None

    def _checksum_is_valid(self, packet):
        """Verify the checksum of a packet."""
        raise NotImplementedError

    def _resynchronise(self):
        """Drop bytes up to the next possible start, which may be inside a corrupted packet."""
        if self._in_sync:
            self.damage["resyncs"] += 1
        self._in_sync, self._gap = False, True
        at, (mask, value) = 1, self.marks[0]
        while at < len(self._buffer) and self._buffer[at] & mask != value:
            at += 1
        self._drop(at)

    def _marked(self, nodes):
        """Mark a packet's first node if bytes were lost before it; return the packet's nodes."""
        nodes["after_gap"] = False
        nodes["after_gap"][0], self._gap = self._gap, False
        return nodes


class ScanDecoder(Decoder):
    """Decoder of the standard scan (SCAN, FORCE_SCAN): nodes of five bytes with check bits.

    Equations (14.1) and (14.2).
    """

    size = 5
    # A quarter of random bytes passes the check bits. So the decoder is in sync again only after
    # RUN valid nodes whose angles advance a little. RUN equal angles show a loss of sync.
    RUN = 4
    WINDOW = RUN * size  # bytes by which synchronisation is decided
    BACK, AHEAD = 5 * 64, 30 * 64  # limits of an angle increment [1/64 degree]

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
        """Return a mask of the nodes whose angles equal those of their three preceding nodes."""
        run = np.concatenate([self._last_angles, angle])
        self._last_angles = run[1 - self.RUN :]
        return (run[3:] == run[2:-1]) & (run[3:] == run[1:-2]) & (run[3:] == run[:-3])

    def _resynchronise(self):
        """Drop bytes up to the first valid nodes or, if there are none, all checked bytes."""
        raw = np.frombuffer(self._buffer, np.uint8)
        offsets = len(raw) - self.WINDOW + 1
        angle = _u16(raw[1:-1], raw[2:])
        fits, angle = _plausible(raw[:-2], angle), angle >> 1
        found = np.ones(offsets, bool)
        advance = np.zeros(offsets, np.int32)
        for k in range(self.RUN):
            found &= fits[5 * k : 5 * k + offsets]
            if k:
                step = angle[5 * k :][:offsets] - angle[5 * k - 5 :][:offsets]
                step = (step + self.BACK) % TURN_Q6 - self.BACK
                found &= step < self.AHEAD
                advance += step
        hits = np.flatnonzero(found & (advance > 0))
        self._in_sync = len(hits) > 0
        self._drop(int(hits[0]) if len(hits) else offsets)


def _u16(low, high):
    return low.astype(np.int32) | high.astype(np.int32) << 8


def _plausible(flags, angle):
    """Verify the check bits (S and its inverse, C = 1), and that the angle is below 360°."""
    return ((flags ^ flags >> 1) & 1 == 1) & (angle & 1 == 1) & (angle >> 1 < TURN_Q6)
