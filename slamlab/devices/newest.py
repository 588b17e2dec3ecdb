"""A place where a thread puts things and another takes them: who is slow gets the newest."""

import threading
from collections import deque


class Newest:
    """The newest things that nobody has taken; older ones are dropped and counted.

    Parameters
    ----------
    room : int, how many are kept

    ``put`` and ``dropped`` count; ``error`` is why no more come, where it was one.
    """

    def __init__(self, room=2):
        self._things, self._news = deque(maxlen=room), threading.Condition()
        self.count, self.dropped, self.over, self.error = 0, 0, True, None

    def begin(self):
        """Forget what there was; things will come."""
        with self._news:
            self._things.clear()
            self.over, self.error = False, None

    def end(self, error=None):
        """No more will come."""
        with self._news:
            self.over, self.error = True, error or self.error
            self._news.notify_all()

    def put(self, things):
        """Put things there, the newest last."""
        with self._news:
            self.count += len(things)
            self.dropped += max(len(self._things) + len(things) - self._things.maxlen, 0)
            self._things.extend(things)
            self._news.notify_all()

    def take(self, latest=False, timeout=None):
        """The next thing, waited for.

        Parameters
        ----------
        latest : bool, whether older ones are skipped
        timeout : float [s], or None to wait until it comes

        Returns
        -------
        whether to wait for it was not in vain, and the thing; None when no more come

        Raises
        ------
        Exception : why no more come
        """
        with self._news:
            if not self._news.wait_for(lambda: self._things or self.over, timeout):
                return False, None
            while latest and len(self._things) > 1:
                self._things.popleft()
            if self._things:
                return True, self._things.popleft()
            if self.error is not None:
                raise self.error
            return True, None
