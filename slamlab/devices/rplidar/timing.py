"""When each point was measured, on the host's clock: the samples themselves are the better clock.

The lidar samples evenly; bytes arrive late by anything from 1 to 16 ms, and never early. So the
line (number of a sample, time) is laid under the arrivals: an early one pulls it down at once, late
ones only as fast as two clocks may differ.
"""

import numpy as np

DRIFT = 0.01  # how fast the line may rise towards late arrivals [s/s]
LOST = 0.1  # later than this, samples must have been lost [s]
WAIT = 1.5  # samples between a measurement and its first byte on the line (Slamtec's SDK)
BITS = 10  # on the line, for a byte
SQUEEZED = 0.1  # of their period, at least, samples stay apart


class SampleTimes:
    """Times of nodes, in the order they were measured.

    Parameters
    ----------
    period : float, from one sample to the next [s]
    baud : int [bit/s]
    decoder : Decoder, whose size, lateness and incomplete packet say how old its last node is
    """

    def __init__(self, period, baud, decoder):
        self.period, self._decoder, self._byte = period, decoder, BITS / baud
        self._next = None  # when the next sample is due [s]
        self._last = -np.inf  # the last time that was given: none goes back behind it [s]

    def of(self, count, arrival):
        """Times of the nodes that the decoder has just returned.

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
        age = (d.pending + d.size) * self._byte + (WAIT + d.late) * self.period
        seen = arrival - age  # the last node was measured then, at the latest
        expected = None if self._next is None else self._next + (count - 1) * self.period
        if expected is None or seen < expected or seen - expected > LOST:
            last = seen
        else:
            last = min(seen, expected + DRIFT * count * self.period)
        self._next = last + self.period
        first = last - (count - 1) * self.period
        if first <= self._last:
            last = max(last, self._last + SQUEEZED * count * self.period)
            first = self._last + (last - self._last) / count
        self._last = last
        return first + (last - first) / max(count - 1, 1) * np.arange(count)
