"""Timestamping: time synchronisation of device and host, corrected for latency and clock drift."""

import numpy as np

MAX_DRIFT = 0.01  # largest clock drift between device and host [s/s]
LOSS_THRESHOLD = 0.1  # beyond this delay samples were lost [s]
SAMPLING_DELAY = 1.5  # samples between a measurement and its first byte on the line (Slamtec's SDK)
BITS_PER_BYTE = 10  # on the line: start, eight data, stop
MIN_SPACING = 0.1  # least interval between timestamps, as a share of the period


class SampleTimestamps:
    """Monotonic timestamps of samples, corrected for transmission time, jitter and clock drift.

    Each arrival time is an upper bound of the sampling time (minimum filter).
    """

    def __init__(self, period, baud, decoder):
        self.period, self._decoder, self._byte_time = period, decoder, BITS_PER_BYTE / baud
        self._next = None  # when the next sample is due [s]
        self._last = -np.inf  # the last timestamp: they never decrease [s]

    def of_samples(self, count, arrival):
        """Return times (count,) [s] of the decoder's last nodes, given the ``arrival`` time [s]."""
        if not count:
            return np.empty(0)
        d = self._decoder
        age = (d.pending + d.size) * self._byte_time + (SAMPLING_DELAY + d.delay) * self.period
        latest = arrival - age  # upper bound of the time of the last node
        # The sampling period is constant. Bytes arrive 1 to 16 ms late, never early (latency of the
        # USB adapter). So the line (index of the sample, time) is a lower bound of the arrivals. An
        # early arrival lowers it at once; late arrivals raise it at most by the clock drift.
        expected = None if self._next is None else self._next + (count - 1) * self.period
        if expected is None or latest < expected or latest - expected > LOSS_THRESHOLD:
            last = latest
        else:
            last = min(latest, expected + MAX_DRIFT * count * self.period)
        self._next = last + self.period
        first = last - (count - 1) * self.period
        if first <= self._last:
            last = max(last, self._last + MIN_SPACING * count * self.period)
            first = self._last + (last - self._last) / count
        self._last = last
        return first + (last - first) / max(count - 1, 1) * np.arange(count)
