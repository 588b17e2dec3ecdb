"""Clocks of drivers and emulators: the monotonic system clock, or simulated time.

Whatever waits in a driver waits by its clock, and its threads are the clock's. So the same drivers
run in simulated time, where nothing hangs on how fast or busy the machine is.
"""

import threading
import time
from math import inf


class Clock:
    """Monotonic system clock."""

    def now(self):
        """Monotonic time [s], float, from an arbitrary start, never backwards."""
        return time.monotonic()

    def sleep(self, seconds):
        """Sleep for so long [s]."""
        time.sleep(seconds)

    def wait_for(self, condition, predicate, timeout=None):
        """Wait until a predicate holds.

        Parameters
        ----------
        condition : threading.Condition that the caller holds, notified of every change
        predicate : callable() -> bool
        timeout : float [s], or None to wait until it holds

        Returns
        -------
        bool, False at a timeout
        """
        return condition.wait_for(predicate, timeout)

    def start_thread(self, function, name):
        """Start a daemon thread of a name that calls a function; threading.Thread."""
        thread = threading.Thread(target=function, name=name, daemon=True)
        thread.start()
        return thread

    def join(self, thread, timeout):
        """Wait until a thread has ended, at most so long [s]."""
        thread.join(timeout)


class SimulatedClock:
    """Simulated clock of several threads (discrete-event simulation): nobody really waits.

    Time passes only while somebody from outside waits for it: a test, whoever takes a reading. Then
    the clock's own threads (those of drivers) run, each at the moment until which it sleeps and
    never two at once. Everybody else's work takes no time at all.

    Parameters
    ----------
    start : float [s]
    """

    def __init__(self, start=0.0):
        self._now, self._changed = start, threading.Condition()
        self._wakes = {}  # thread of the clock: until when it sleeps [s]
        self._running = None  # the one of them that runs

    def now(self):
        """Simulated time [s], float."""
        return self._now

    def sleep(self, seconds):
        """Sleep for so much simulated time [s]."""
        end = self._now + max(seconds, 0.0)
        if threading.current_thread() in self._wakes:
            self._pass_on(end)
        else:
            while self._run_next(end):
                pass

    def wait_for(self, condition, predicate, timeout=None):
        """Let simulated time pass until a predicate holds: see :meth:`Clock.wait_for`."""
        end = inf if timeout is None else self._now + timeout
        while not predicate():
            condition.release()
            try:
                ran = self._run_next(end)
            finally:
                condition.acquire()
            if not ran:
                return predicate()
        return True

    def start_thread(self, function, name):
        """Thread of this clock: see :meth:`Clock.start_thread`; it runs when time passes."""
        thread = threading.Thread(target=self._run, args=(function,), name=name, daemon=True)
        with self._changed:
            self._wakes[thread] = self._now
        thread.start()
        return thread

    def join(self, thread, timeout):
        """Let simulated time pass until a thread has ended, at most so much [s]."""
        end = self._now + timeout
        while thread in self._wakes and self._run_next(end):
            pass

    def _run(self, function):
        thread = threading.current_thread()
        try:
            with self._changed:
                self._changed.wait_for(lambda: self._running is thread)
            function()
        finally:
            with self._changed:
                del self._wakes[thread]
                self._running = None
                self._changed.notify_all()

    def _pass_on(self, wake):
        """A thread of the clock sleeps until a moment [s]; others run meanwhile."""
        thread = threading.current_thread()
        with self._changed:
            self._wakes[thread], self._running = wake, None
            self._changed.notify_all()
            self._changed.wait_for(lambda: self._running is thread)

    def _run_next(self, end):
        """Let the clock's thread run whose moment is next; bool, False where none is by ``end``."""
        with self._changed:
            self._changed.wait_for(lambda: self._running is None)
            thread = min(self._wakes, key=self._wakes.get, default=None)
            if thread is None or self._wakes[thread] > end:
                if end < inf:
                    self._now = max(self._now, end)
                return False
            self._now, self._running = max(self._now, self._wakes[thread]), thread
            self._changed.notify_all()
            self._changed.wait_for(lambda: self._running is not thread)
            return True
