"""When a further worker joins in: its start costs as much as dozens of submissions take."""

import threading
import time

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
        self._count, self._clock, self._patience = count, clock, patience
        self._begun, self._start, self._done = clock(), 0.0, 0
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
            self._done, took = self._done + 1, self._clock() - self._begun
            if self._done == 1:
                self._start = took
            left, others = self._count - self._done, self._done - 1
            pays = left * (took - self._start) > others * self._start
        if left <= 0 or pays:
            self.release()

    def release(self):
        """Let all go on: what is left takes longer than a start, or nothing is left to do."""
        self._pays.set()
