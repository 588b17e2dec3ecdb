"""Background thread that reads from a source; a timeout keeps the notebook responsive."""

import threading
from time import monotonic
from weakref import WeakValueDictionary

_readers = WeakValueDictionary()  # id of a source to its last reader


class BackgroundReader:
    """Non-blocking reader: requests one reading of a source at a time, each in a new thread. A
    source that waits for a device should end its iteration when it is closed. ``ended``: whether
    the source has no more readings.
    """

    def __init__(self, source):
        self.source, self.ended = source, False
        self._readings = self._request = None

    @property
    def waited(self):
        """Time since the beginning of the wait for a reading [s]."""
        return 0.0 if self._request is None else monotonic() - self._request.began

    @property
    def blocked(self):
        return self._request is not None and self._request.is_alive()

    def next_reading(self, timeout):
        """Return the next reading, or None after a timeout [s] or at the end; raise the source's
        errors.
        """
        if self.ended:
            return None
        if self._request is None:
            self._request = _ReadRequest(self._next)
        request = self._request
        request.join(timeout)
        if request.is_alive():
            return None
        self._request = None
        self.ended = request.reading is None
        if request.error is not None:
            raise request.error
        return request.reading

    def _next(self):
        # starting the iteration may take as long as a reading
        if self._readings is None:
            self._readings = iter(self.source)
        return next(self._readings, None)


class _ReadRequest(threading.Thread):
    def __init__(self, function):
        # a daemon: a source that never answers must not keep the kernel from ending
        super().__init__(name="slamlab waits for a reading", daemon=True)
        self._function, self.began = function, monotonic()
        self.reading = self.error = None
        self.start()

    def run(self):
        try:
            self.reading = self._function()
        except Exception as error:
            self.error = error


def background_reader(source):
    """Return a new reader of a source, or the source's last reader if that reader still blocks."""
    known = _readers.get(id(source))
    # two readers must not read one device at once
    if known is None or not known.blocked:
        known = _readers[id(source)] = BackgroundReader(source)
    return known
