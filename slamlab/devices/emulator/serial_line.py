"""Serial line of an emulated device: baud rate, buffer overflow, and corrupted or lost bytes."""

from collections import deque
from dataclasses import dataclass, field

import numpy as np

BITS_PER_BYTE = 10  # on the line: start, eight data, stop


@dataclass
class Faults:
    """Fault injection: what goes wrong; may be changed while the device runs.

    Parameters
    ----------
    flip : float, share of bytes corrupted by a flipped bit
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


class SerialLine:
    """Serial line: buffers packets and sends them at the baud rate, with faults.

    Parameters
    ----------
    baud : int [bit/s]
    faults : Faults
    rng : numpy.random.Generator, of the damage
    capacity : int, bytes that can wait; more are dropped whole packets at a time, and counted
    """

    def __init__(self, baud, faults, rng, capacity=4096):
        self._faults, self._rng, self._capacity = faults, rng, capacity
        self._byte_time = BITS_PER_BYTE / baud
        self._packets, self._waiting, self._free_at = deque(), 0, 0.0
        self._sent = []
        self.dropped = 0

    def put(self, packet, ready):
        """Queue a packet behind those there; ``ready`` is when it can be sent [s]."""
        stale, self._faults.stale = self._faults.stale, b""
        packet = stale + packet
        self._send(ready)  # what goes by then takes no room
        if self._waiting + len(packet) > self._capacity:
            self.dropped += len(packet)
        elif packet:
            self._packets.append((ready, packet))
            self._waiting += len(packet)

    def take(self, now):
        """Take the bytes that have gone over the line since the last call.

        Parameters
        ----------
        now : float [s]

        Returns
        -------
        bytes
        """
        self._send(now)
        sent, self._sent = b"".join(self._sent), []
        return self._corrupted(sent)

    def _send(self, now):
        while self._packets:
            ready, packet = self._packets[0]
            self._free_at = max(self._free_at, ready)
            n = min(int((now - self._free_at) / self._byte_time + 1e-6), len(packet))
            if n <= 0:
                break
            self._free_at += n * self._byte_time
            self._waiting -= n
            self._sent.append(packet[:n])
            if n == len(packet):
                self._packets.popleft()
            else:
                self._packets[0] = ready, packet[n:]

    def _corrupted(self, data):
        if not self._faults.flip and not self._faults.lose:
            return data
        raw = np.frombuffer(data, np.uint8).copy()
        hit = self._rng.random(len(raw)) < self._faults.flip
        raw[hit] ^= (1 << self._rng.integers(0, 8, hit.sum())).astype(np.uint8)
        return raw[self._rng.random(len(raw)) >= self._faults.lose].tobytes()
