"""Latest-value queue from a reader thread to its consumer: on overflow the oldest are dropped."""

import threading
from collections import deque


class LatestQueue:
    """Bounded queue that keeps the newest items: on overflow the oldest are dropped and counted.

    Parameters
    ----------
    clock : Clock, by which items are waited for
    maxsize : int, how many are kept

    ``count`` and ``dropped`` items are counted; ``error`` is why no more come, where it was one.
    """

    def __init__(self, clock, maxsize=2):
        self._clock, self._items, self._changed = (
            clock,
            deque(maxlen=maxsize),
            threading.Condition(),
        )
        self.count, self.dropped, self.finished, self.error = 0, 0, True, None

    def start(self):
        """Open the queue anew, empty: items will come."""
        with self._changed:
            self._items.clear()
            self.finished, self.error = False, None

    def finish(self, error=None):
        """Close the queue: no more items will come."""
        with self._changed:
            self.finished, self.error = True, error or self.error
            self._changed.notify_all()

    def put(self, items):
        """Append items, the newest last; on overflow drop the oldest."""
        with self._changed:
            self.count += len(items)
            self.dropped += max(len(self._items) + len(items) - self._items.maxlen, 0)
            self._items.extend(items)
            self._changed.notify_all()

    def get(self, latest=False, timeout=None):
        """Next item, waited for.

        Parameters
        ----------
        latest : bool, whether older ones are skipped
        timeout : float [s], or None to wait until it comes

        Returns
        -------
        bool, False at a timeout, and the item; None when no more come

        Raises
        ------
        Exception : why no more come
        """
        with self._changed:
            there = self._clock.wait_for(
                self._changed, lambda: self._items or self.finished, timeout
            )
            if not there:
                return False, None
            while latest and len(self._items) > 1:
                self._items.popleft()
            if self._items:
                return True, self._items.popleft()
            if self.error is not None:
                raise self.error
            return True, None
