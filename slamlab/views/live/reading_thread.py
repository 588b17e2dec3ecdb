"""Background thread that reads from a source, with a timeout: a device blocks no notebook."""

import threading
from time import monotonic
from weakref import WeakValueDictionary

_readers = WeakValueDictionary()  # by id of the source: the last one that was made of it


class BackgroundReader:
    """Non-blocking reader: asks a source for one reading at a time, waits until a timeout at most.

    Each reading is asked for in a thread that ends with its answer. So there is a thread only
    while a source keeps somebody waiting, and closing such a source ends it.

    Parameters
    ----------
    source : Source; one that waits for a device should end its iteration when it is closed

    ``ended`` says whether the source has no more, or has failed.
    """

    def __init__(self, source):
        self.source, self.ended = source, False
        self._readings = self._request = None

    @property
    def waited(self):
        """Waiting time, float: how long a reading is being waited for [s]; 0 when none is."""
        return 0.0 if self._request is None else monotonic() - self._request.began

    @property
    def blocked(self):
        """bool, whether a thread is blocked in the source, waiting for its reading."""
        return self._request is not None and self._request.is_alive()

    def next_reading(self, timeout):
        """Next reading of the source, or None after a timeout.

        Parameters
        ----------
        timeout : float [s], or None to wait until it comes

        Returns
        -------
        Reading, or None when none came in that time or the source has ended

        Raises
        ------
        Exception : what the source raised
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
        self.ended = request.answer is None
        if request.error is not None:
            raise request.error
        return request.answer

    def _next(self):
        # to begin may take as long as a reading
        if self._readings is None:
            self._readings = iter(self.source)
        return next(self._readings, None)


class _ReadRequest(threading.Thread):
    """Thread that calls a function; holds what it returned or raised (a future)."""

    def __init__(self, function):
        # a source that never answers must not keep the kernel from ending
        super().__init__(name="slamlab waits for a reading", daemon=True)
        self._function, self.began = function, monotonic()
        self.answer = self.error = None
        self.start()

    def run(self):
        try:
            self.answer = self._function()
        except Exception as error:
            self.error = error


def background_reader(source):
    """Background reader of a source from its start; of one that still blocks, the same again.

    Parameters
    ----------
    source : Source

    Returns
    -------
    BackgroundReader
    """
    known = _readers.get(id(source))
    # two must not read one device at once
    if known is None or not known.blocked:
        known = _readers[id(source)] = BackgroundReader(source)
    return known
