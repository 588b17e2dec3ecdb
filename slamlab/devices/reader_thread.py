"""Reader thread of a driver, and exponential back-off between attempts to reconnect.

One thread reads the port, so that no slow plot or sleeping cell overflows its buffers.
"""

import threading

from slamlab.devices.errors import SlamlabError

BACKOFF = 0.5, 5.0  # first and longest delay before another attempt to reconnect [s]
STOP_CHECK = 0.05  # how often a delay looks whether it is to end [s]


class ReaderThread:
    """Daemon thread that repeats a step until it is stopped or the step raises.

    Parameters
    ----------
    step : callable(stopping) that waits a moment at most, or until the Event it is given is set
    name : str, of the thread
    on_end : callable(error or None), called by the thread as its last
    clock : Clock, whose thread it is
    """

    def __init__(self, step, name, on_end, clock):
        self._step, self._on_end, self._name, self._clock = step, on_end, name, clock
        self.stopping, self._thread = threading.Event(), None

    def start(self):
        """Start the thread."""
        self._thread = self._clock.start_thread(self._run, self._name)

    def stop(self, timeout=2.0):
        """Stop the thread and join it, at most so long [s]; may be called from it, and again."""
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


def backoff(clock, stopping):
    """Exponential back-off: delays between attempts to reconnect (retries), each twice the last.

    Parameters
    ----------
    clock : Clock
    stopping : threading.Event, set to cancel further retries

    Yields
    ------
    None, after each delay
    """
    delay, longest = BACKOFF
    while True:
        end = clock.now() + delay
        while clock.now() < end and not stopping.is_set():
            clock.sleep(STOP_CHECK)
        if stopping.is_set():
            return
        yield
        delay = min(2 * delay, longest)
