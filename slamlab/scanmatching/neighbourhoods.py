"""Neighbourhoods of a scan's points: sliding windows over the beams, and sums over them."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Windows:
    """Sliding windows over a ring of n points: i is j's neighbour where j is i's.

    Parameters
    ----------
    ring : (n + 2k,) int, the points in order, k more at either end
    first, last : (n,) int, places in the ring between which a point's neighbours stand
    """

    ring: np.ndarray
    first: np.ndarray
    last: np.ndarray

    @property
    def count(self):
        """Window sizes: (n,) how many neighbours each point has, itself among them."""
        return self.last - self.first

    def sums(self, values):
        """Sums over each point's window, as differences of cumulative (running) sums.

        Parameters
        ----------
        values : (m, n)

        Returns
        -------
        (m, n)
        """
        running = np.zeros((len(values), len(self.ring) + 1))
        np.cumsum(values.take(self.ring, axis=1), axis=1, out=running[:, 1:])
        return running.take(self.last, axis=1) - running.take(self.first, axis=1)


def sliding_windows(jump, k):
    """Sliding windows of k neighbours to either side of each point, none beyond a range jump.

    Parameters
    ----------
    jump : (n,) bool, range discontinuity: another surface begins behind this point
    k : int

    Returns
    -------
    Windows
    """
    n = len(jump)
    ring = np.arange(-k, n + k)
    ring[:k] += n
    ring[n + k :] -= n
    cuts = np.concatenate(([0], jump[ring].nonzero()[0] + 1, [n + 2 * k]))
    length, first = cuts[1:] - cuts[:-1], np.arange(n)
    begin, end = (c.repeat(length)[k : n + k] for c in (cuts[:-1], cuts[1:]))
    return Windows(ring, np.maximum(first, begin), np.minimum(first + (2 * k + 1), end))
