"""Lease of the controls (dead man's switch): one holds it at a time, and renews it or loses it."""

import time

LENGTH = 1.0  # of a lease that is not renewed [s]


class Taken(ValueError):
    """Somebody else holds the lease; the text says who."""


class Lease:
    """Lease of the controls.

    Parameters
    ----------
    length : float, for how long it holds without being renewed [s]
    clock : callable -> float [s]
    """

    def __init__(self, length=LENGTH, clock=time.monotonic):
        self._length, self._clock = length, clock
        self._holder, self._renewed = None, 0.0

    @property
    def holder(self):
        """Who holds it, as it was said when it was taken; None when it lapsed or nobody does."""
        if self._holder is not None and self._clock() - self._renewed > self._length:
            self._holder = None
        return self._holder

    def take(self, who):
        """Take the lease, or renew one's own.

        Parameters
        ----------
        who : hashable, not None

        Raises
        ------
        Taken : somebody else holds it
        """
        if self.holder not in (None, who):
            raise Taken("somebody else drives: wait until the robot stands, or stop it")
        self._holder, self._renewed = who, self._clock()

    def renew(self, who):
        """Renew the lease.

        Returns
        -------
        bool, whether it was held by who asks: one that has lapsed is not renewed
        """
        mine = self.holder == who
        if mine:
            self._renewed = self._clock()
        return mine

    def release(self, who):
        """Give the lease back; of somebody else it stays."""
        if self._holder == who:
            self._holder = None
