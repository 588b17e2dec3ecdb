"""Time as devices and their drivers see it; a simulated one makes hours pass in a moment."""

import threading
import time


class Clock:
    """The machine's own monotonic time."""

    def now(self):
        """float [s], from an arbitrary start, never backwards."""
        return time.monotonic()

    def sleep(self, seconds):
        """Let so much time pass [s]."""
        time.sleep(seconds)


class SimulatedClock:
    """Time that passes only when somebody sleeps.

    Parameters
    ----------
    start : float [s]
    """

    def __init__(self, start=0.0):
        self._now, self._lock = start, threading.Lock()

    def now(self):
        """float [s]"""
        return self._now

    def sleep(self, seconds):
        """Let so much time pass [s], at once."""
        with self._lock:
            self._now += max(seconds, 0.0)
