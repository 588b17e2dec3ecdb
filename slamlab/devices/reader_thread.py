"""Reader thread of a driver, and the timer that measures its receive timeout."""

import threading

from slamlab.devices.errors import SlamlabError

MAX_INCREMENT = 0.1  # largest increment of the elapsed time per read [s]: the process was suspended


class ReaderThread:
    """Daemon thread that calls step(stopping) until stop() is called or a SlamlabError is raised.

    A step must return soon, at the latest when the Event ``stopping`` is set. At the end, the
    thread calls on_end(error or None).
    """

    def __init__(self, step, name, on_end, clock):
        self._step, self._on_end, self._name, self._clock = step, on_end, name, clock
        self.stopping, self._thread = threading.Event(), None

    def start(self):
        self._thread = self._clock.start_thread(self._run, self._name)

    def stop(self, timeout=2.0):
        """Stop and join the thread within the timeout [s]; the thread itself may also call this."""
        self.stopping.set()
        if self._thread is not None and self._thread is not threading.current_thread():
            self._clock.join(self._thread, timeout)

    def _run(self):
        error = None
        try:
            while not self.stopping.is_set():
                self._step(self.stopping)
        except SlamlabError as raised:
            error = None if self.stopping.is_set() else raised
        finally:
            self._on_end(error)


class ReceiveTimer:
    """Measures ``elapsed``, the time since the last data [s], except while suspended."""

    def __init__(self, now):
        self.elapsed, self._last = 0.0, now

    def update(self, now, received):
        """Update the timer after a read that ended at ``now`` [s], and return ``elapsed``."""
        self.elapsed = 0.0 if received else self.elapsed + min(now - self._last, MAX_INCREMENT)
        self._last = now
        return self.elapsed
