"""Timestamping: when each point was measured on the host's clock, despite latency and clock drift.

The lidar samples evenly; bytes arrive late by anything from 1 to 16 ms (jitter), and never early.
So the line (number of a sample, time) is laid under the arrivals: an early one pulls it down at
once, late ones only as fast as the two clocks may drift apart.
"""

import numpy as np

MAX_DRIFT = 0.01  # clock drift: how fast the line may rise towards late arrivals [s/s]
LOSS_THRESHOLD = 0.1  # later than this, samples must have been lost [s]
SAMPLING_DELAY = 1.5  # samples between a measurement and its first byte on the line (Slamtec's SDK)
BITS_PER_BYTE = 10  # on the line: start, eight data, stop
MIN_SPACING = 0.1  # share of the period that timestamps stay apart at least


class SampleTimestamps:
    """Timestamps of nodes, monotonic, corrected for transmission time, jitter and clock drift.

    Parameters
    ----------
    period : float, from one sample to the next [s]
    baud : int [bit/s]
    decoder : Decoder, whose packet size, delay and pending bytes say how old its last node is
    """

    def __init__(self, period, baud, decoder):
        self.period, self._decoder, self._byte_time = period, decoder, BITS_PER_BYTE / baud
        self._next = None  # when the next sample is due [s]
        self._last = -np.inf  # the last time that was given: none goes back behind it [s]

    def of_samples(self, count, arrival):
        """Timestamps of the nodes that the decoder has just returned.

        Parameters
        ----------
        count : int, how many
        arrival : float, when the last byte fed to it was there [s]

        Returns
        -------
        (count,) [s]
        """
        if not count:
            return np.empty(0)
        d = self._decoder
        age = (d.pending + d.size) * self._byte_time + (SAMPLING_DELAY + d.delay) * self.period
        latest = arrival - age  # the last node was measured then, at the latest
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
