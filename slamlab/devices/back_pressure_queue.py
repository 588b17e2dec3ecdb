"""Back-pressure: a bounded queue between reader thread and consumer that drops the oldest items."""

import threading
from collections import deque

MAX_ITEMS = 2  # capacity of the queue


class DropOldestQueue:
    """Latest-value queue: a bounded queue that drops the oldest items on overflow.

    ``count``: number of items; ``dropped``: number of dropped items; ``error``: exception that
    ended the stream.
    """

    def __init__(self, clock):
        self._clock, self._changed = clock, threading.Condition()
        self._items = deque(maxlen=MAX_ITEMS)
        self.count, self.dropped, self.finished, self.error = 0, 0, True, None

    def start(self):
        with self._changed:
            self._items.clear()
            self.finished, self.error = False, None

    def finish(self, error=None):
        with self._changed:
            self.finished, self.error = True, error or self.error
            self._changed.notify_all()

    def put(self, items):
        with self._changed:
            self.count += len(items)
            self.dropped += max(len(self._items) + len(items) - self._items.maxlen, 0)
            self._items.extend(items)
            self._changed.notify_all()

    def get(self, latest=False, timeout=None):
        """Wait for the next or the latest item and return (True, item).

        Return (False, None) after the timeout [s]. At the end, the item is None. Raises ``error``.
        """
        with self._changed:
            if not self._clock.wait_for(
                self._changed, lambda: self._items or self.finished, timeout
            ):
                return False, None
            while latest and len(self._items) > 1:
                self._items.popleft()
            if self._items:
                return True, self._items.popleft()
            if self.error is not None:
                raise self.error
            return True, None
