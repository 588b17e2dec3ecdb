"""Clocks of drivers and emulators: the monotonic system clock, or simulated time for tests."""

import threading
import time


class Clock:
    """Monotonic system clock."""

    def now(self):
        """Monotonic time [s], float, from an arbitrary start, never backwards."""
        return time.monotonic()

    def sleep(self, seconds):
        """Sleep for so long [s]."""
        time.sleep(seconds)


class SimulatedClock:
    """Simulated clock, whose time passes only when somebody sleeps: tests do not wait.

    Parameters
    ----------
    start : float [s]
    """

    def __init__(self, start=0.0):
        self._now, self._lock = start, threading.Lock()

    def now(self):
        """Simulated time [s], float."""
        return self._now

    def sleep(self, seconds):
        """Advance the simulated time by so much [s], without waiting."""
        with self._lock:
            self._now += max(seconds, 0.0)
