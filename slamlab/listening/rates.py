"""How often something may be done: a bucket for each who asks, and one for all."""

from typing import NamedTuple


class Rate(NamedTuple):
    """So many at once, and then so many a second."""

    burst: float
    per_second: float


class Bucket:
    """A bucket that time fills again: each deed takes a drop, and none is done when it is empty.

    Parameters
    ----------
    rate : Rate
    clock : callable -> float [s]
    """

    def __init__(self, rate, clock):
        self._rate, self._clock = rate, clock
        self._level, self._filled = rate.burst, clock()

    def take(self):
        """bool, whether it may be done now; if so, it counts as done."""
        now = self._clock()
        grown = self._level + (now - self._filled) * self._rate.per_second
        self._level, self._filled = min(self._rate.burst, grown), now
        if self._level < 1:
            return False
        self._level -= 1
        return True


class Buckets:
    """A bucket for each of many, whose number is bounded, and one for all of them together.

    Parameters
    ----------
    each, together : Rate
    clock : callable -> float [s]
    most : int, of how many a bucket is kept; who asked longest ago is forgotten
    """

    def __init__(self, each, together, clock, most=4096):
        self._each, self._clock, self._most = each, clock, most
        self._of, self._together = {}, Bucket(together, clock)

    def take(self, who):
        """bool, whether one of many may do it now.

        Parameters
        ----------
        who : str
        """
        own = self._of.pop(who, None) or Bucket(self._each, self._clock)
        self._of[who] = own  # who asked last stands last
        if len(self._of) > self._most:
            del self._of[next(iter(self._of))]
        return own.take() and self._together.take()
