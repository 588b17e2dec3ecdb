"""The one thread that reads a port, so that no slow picture or sleeping cell makes data pile up."""

import threading

from slamlab.devices.errors import SlamlabError

RETRY = 0.5, 5.0  # first and longest pause before another try to connect again [s]
LOOK = 0.05  # how often it is looked whether to give that up [s]


class Reader:
    """Calls a step again and again, in a daemon thread, until it is stopped or the step raises.

    Parameters
    ----------
    step : callable(stopping) that waits a moment at most, or until the Event it is given is set
    name : str, of the thread
    on_end : callable(error or None), called by the thread as its last
    """

    def __init__(self, step, name, on_end):
        self._step, self._on_end = step, on_end
        self.stopping = threading.Event()
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)

    def start(self):
        """Begin."""
        self._thread.start()

    def stop(self, patience=2.0):
        """Let the thread end, and wait for it so long [s]; may be called from it, and again."""
        self.stopping.set()
        if self._thread.is_alive() and self._thread is not threading.current_thread():
            self._thread.join(patience)

    def _run(self):
        error = None
        try:
            while not self.stopping.is_set():
                self._step(self.stopping)
        except SlamlabError as raised:
            error = None if self.stopping.is_set() else raised
        finally:
            self._on_end(error)


def retries(clock, stopping):
    """Pause longer and longer between tries.

    Parameters
    ----------
    clock : Clock
    stopping : threading.Event, set when nobody wants any more of them

    Yields
    ------
    None, after each pause
    """
    pause, longest = RETRY
    while True:
        end = clock.now() + pause
        while clock.now() < end and not stopping.is_set():
            clock.sleep(LOOK)
        if stopping.is_set():
            return
        yield
        pause = min(2 * pause, longest)
