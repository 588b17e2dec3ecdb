"""Clocks of the drivers: monotonic system clock, and simulated time (discrete events)."""

import threading
import time
from math import inf


class Clock:
    """Monotonic system clock."""

    def now(self):
        """Return the monotonic time [s]."""
        return time.monotonic()

    def sleep(self, seconds):
        time.sleep(seconds)

    def wait_for(self, condition, predicate, timeout=None):
        """Wait on a locked condition; return whether predicate() became true within timeout [s]."""
        return condition.wait_for(predicate, timeout)

    def start_thread(self, function, name):
        thread = threading.Thread(target=function, name=name, daemon=True)
        thread.start()
        return thread

    def join(self, thread, timeout):
        """Wait until a thread has ended, but no longer than the timeout [s]."""
        thread.join(timeout)


class SimulatedClock:
    """Simulated time for several threads (discrete-event simulation).

    Time advances only while a thread outside the clock waits. During this wait, the
    clock's threads run one at a time, in the order of their wake-up times.
    """

    def __init__(self, start=0.0):
        self._now, self._changed = start, threading.Condition()
        self._wakes = {}  # wake-up time of each thread of the clock [s]
        self._running = None  # the thread that runs now

    def now(self):
        return self._now

    def sleep(self, seconds):
        end = self._now + max(seconds, 0.0)
        if threading.current_thread() in self._wakes:
            self._sleep_until(end)
        else:
            while self._run_next(end):
                pass

    def wait_for(self, condition, predicate, timeout=None):
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
        thread = threading.Thread(target=self._run, args=(function,), name=name, daemon=True)
        with self._changed:
            self._wakes[thread] = self._now
        thread.start()
        return thread

    def join(self, thread, timeout):
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

    def _sleep_until(self, wake):
        thread = threading.current_thread()
        with self._changed:
            self._wakes[thread], self._running = wake, None
            self._changed.notify_all()
            self._changed.wait_for(lambda: self._running is thread)

    def _run_next(self, end):
        """Run the thread that wakes up next; return False if none wakes up until ``end`` [s]."""
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
