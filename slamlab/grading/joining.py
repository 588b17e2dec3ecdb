"""When a further worker joins in: its start costs as much as dozens of submissions take."""

import threading
import time
from itertools import pairwise
from statistics import mean

PATIENCE = 10.0  # after which the others join in whatever is done: the first may hang [s]


class Joining:
    """Holds all threads of a pool but the first until what is left takes longer than a start.

    The initializer of a pool's threads.

    Parameters
    ----------
    count : int, how many submissions there are
    clock : () -> float [s]
    patience : float, after which all join in [s]
    """

    def __init__(self, count, clock=time.monotonic, patience=PATIENCE):
        self._left, self._clock, self._patience = count, clock, patience
        self._at = [clock()]
        self._lock, self._first, self._pays = threading.Lock(), True, threading.Event()

    def __call__(self):
        """Wait until it pays to go on; the first one never waits."""
        with self._lock:
            first, self._first = self._first, False
        if not first:
            self._pays.wait(self._patience)

    def done(self, _=None):
        """Note that one more submission is done."""
        with self._lock:
            self._left -= 1
            self._at.append(self._clock())
            start, *others = (after - before for before, after in pairwise(self._at))
        if self._left <= 0 or (others and self._left * mean(others) > start):
            self.release()

    def release(self):
        """Let all go on: what is left takes longer than a start, or nothing is left to do."""
        self._pays.set()
