"""Serial line (UART) of an emulated device: baud rate, overflow, corrupted and lost bytes."""

from collections import deque
from dataclasses import dataclass, field

import numpy as np

BITS_PER_BYTE = 10  # on the line: start, eight data, stop
CAPACITY = 4096  # of the transmit buffer [byte]
MISMATCH = 0x5A  # wrong bits of each byte at another baud rate


@dataclass
class Faults:
    """Injected faults, which can be changed while the device runs.

    ``flip``: share of the bytes with a flipped bit; ``lose``: share of lost bytes; ``stale``: bytes
    before the next response; ``silent``: commands that get no response; ``stalled``: whether the
    motor is blocked; ``blind``: whether no sample has a distance; ``unknown_type``: whether all
    modes except the standard scan send data of an unknown type.
    """

    flip: float = 0.0
    lose: float = 0.0
    stale: bytes = b""
    silent: set = field(default_factory=set)
    stalled: bool = False
    blind: bool = False
    unknown_type: bool = False
    unplugged: bool = False


class BaudRateMismatch:
    """A device whose client uses another baud rate, so that all bytes are corrupted."""

    def __init__(self, device):
        self._device = device

    def feed(self, data, now):
        return bytes(byte ^ MISMATCH for byte in self._device.feed(b"", now))


def with_baud_rate(device, baud):
    """Return the device or, if the baud rates differ, a BaudRateMismatch; TCP has ``baud`` None."""
    own = getattr(device, "baud", None)
    return device if None in (own, baud) or own == baud else BaudRateMismatch(device)


class SerialLine:
    """Line that sends packets at the baud rate, with faults; drops packets beyond CAPACITY."""

    def __init__(self, baud, faults, rng):
        self._faults, self._rng = faults, rng
        self._byte_time = BITS_PER_BYTE / baud
        self._packets, self._waiting, self._free_at = deque(), 0, 0.0
        self._sent = []
        self.dropped = 0

    def put(self, packet, ready):
        """Queue a packet for transmission after the time ``ready`` [s]."""
        stale, self._faults.stale = self._faults.stale, b""
        packet = stale + packet
        self._send(ready)  # frees the buffer of the bytes sent by then
        if self._waiting + len(packet) > CAPACITY:
            self.dropped += len(packet)
        elif packet:
            self._packets.append((ready, packet))
            self._waiting += len(packet)

    def take(self, now):
        """Return the bytes that have been transmitted since the last call."""
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
