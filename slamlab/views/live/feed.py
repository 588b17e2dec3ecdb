"""Readings asked of a source in a thread: the source may keep one waiting, the notebook goes on."""

import threading
from time import monotonic
from weakref import WeakValueDictionary

_feeds = WeakValueDictionary()  # by id of the source: the last one that was made of it


class Feed:
    """Asks a source for one reading at a time and waits for it no longer than one wants to.

    Each reading is asked for in a thread that ends with its answer. So there is a thread only
    while a source keeps somebody waiting, and closing such a source ends it.

    Parameters
    ----------
    source : Source; one that waits for a device should end its iteration when it is closed

    ``ended`` says whether the source has no more, or has failed.
    """

    def __init__(self, source):
        self.source, self.ended = source, False
        self._readings = self._question = None

    @property
    def waited(self):
        """float, for how long a reading has been waited for [s]; 0 when none is asked for."""
        return 0.0 if self._question is None else monotonic() - self._question.began

    @property
    def blocked(self):
        """bool, whether a thread waits in the source."""
        return self._question is not None and self._question.is_alive()

    def take(self, patience):
        """The next reading.

        Parameters
        ----------
        patience : float [s], or None to wait until it comes

        Returns
        -------
        Reading, or None when none came in that time or the source has ended

        Raises
        ------
        Exception : what the source raised
        """
        if self.ended:
            return None
        if self._question is None:
            self._question = _Question(self._next)
        question = self._question
        question.join(patience)
        if question.is_alive():
            return None
        self._question = None
        self.ended = question.answer is None
        if question.trouble is not None:
            raise question.trouble
        return question.answer

    def _next(self):
        # to begin may take as long as a reading
        if self._readings is None:
            self._readings = iter(self.source)
        return next(self._readings, None)


class _Question(threading.Thread):
    """Calls a function; holds what it returned or raised."""

    def __init__(self, function):
        # a source that never answers must not keep the kernel from ending
        super().__init__(name="slamlab waits for a reading", daemon=True)
        self._function, self.began = function, monotonic()
        self.answer = self.trouble = None
        self.start()

    def run(self):
        try:
            self.answer = self._function()
        except Exception as error:
            self.trouble = error


def feed(source):
    """A feed of a source from its start; of one that keeps somebody waiting, the same again.

    Parameters
    ----------
    source : Source

    Returns
    -------
    Feed
    """
    known = _feeds.get(id(source))
    # two must not read one device at once
    if known is None or not known.blocked:
        known = _feeds[id(source)] = Feed(source)
    return known
