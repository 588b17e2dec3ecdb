"""The serial line of an emulated device: so many bytes a second, and what can happen to them."""

from collections import deque
from dataclasses import dataclass, field

import numpy as np

BITS = 10  # on the line, for a byte


@dataclass
class Faults:
    """What goes wrong; may be changed while the device runs.

    Parameters
    ----------
    flip : float, share of bytes of which a bit is flipped
    lose : float, share of bytes that are lost
    stale : bytes of former times, still on their way: they come before the next answer, once
    silent : commands that are not answered
    stalled : bool, whether the motor is blocked
    unplugged : bool, whether reading and writing fail
    """

    flip: float = 0.0
    lose: float = 0.0
    stale: bytes = b""
    silent: set = field(default_factory=set)
    stalled: bool = False
    unplugged: bool = False


class Line:
    """Bytes that wait to be sent, and are, as fast as the line goes.

    Parameters
    ----------
    baud : int [bit/s]
    faults : Faults
    rng : numpy.random.Generator, of the damage
    room : int, bytes that can wait; more are dropped whole packets at a time, and counted
    """

    def __init__(self, baud, faults, rng, room=4096):
        self._byte, self._faults, self._rng, self._room = BITS / baud, faults, rng, room
        self._packets, self._waiting, self._free = deque(), 0, 0.0
        self._sent = []
        self.dropped = 0

    def put(self, packet, ready):
        """Let a packet wait behind what is there; ``ready`` is when it can begin [s]."""
        stale, self._faults.stale = self._faults.stale, b""
        packet = stale + packet
        self._send(ready)  # what goes by then needs no room
        if self._waiting + len(packet) > self._room:
            self.dropped += len(packet)
        elif packet:
            self._packets.append((ready, packet))
            self._waiting += len(packet)

    def take(self, now):
        """What has gone over the line by now, and was not taken before.

        Parameters
        ----------
        now : float [s]

        Returns
        -------
        bytes
        """
        self._send(now)
        sent, self._sent = b"".join(self._sent), []
        return self._damaged(sent)

    def _send(self, now):
        while self._packets:
            ready, packet = self._packets[0]
            self._free = max(self._free, ready)
            n = min(int((now - self._free) / self._byte + 1e-6), len(packet))
            if n <= 0:
                break
            self._free += n * self._byte
            self._waiting -= n
            self._sent.append(packet[:n])
            if n == len(packet):
                self._packets.popleft()
            else:
                self._packets[0] = ready, packet[n:]

    def _damaged(self, data):
        if not self._faults.flip and not self._faults.lose:
            return data
        raw = np.frombuffer(data, np.uint8).copy()
        hit = self._rng.random(len(raw)) < self._faults.flip
        raw[hit] ^= (1 << self._rng.integers(0, 8, hit.sum())).astype(np.uint8)
        return raw[self._rng.random(len(raw)) >= self._faults.lose].tobytes()
