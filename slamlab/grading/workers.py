"""Where workers come from: one place that knows how this machine starts them."""

import sys
import threading

from slamlab.grading import jail
from slamlab.grading.forked import Broken, Zygote
from slamlab.grading.fresh import Fresh

FORKS = sys.platform == "linux"
"""On macOS a fork after Apple's libraries were used is unsafe, on Windows there is none."""


class CannotStart(Exception):
    """A worker did not come up, or was not to: no fault of the student's."""


class Workers:
    """Starts workers for exercises; a zygote stands ready for each exercise and thread.

    Parameters
    ----------
    level : str, one of ``jail.LEVELS``; bounded workers exist on Linux only
    warm : bool, whether many are to come, so that importing beforehand pays
    """

    def __init__(self, level=jail.NONE, warm=True):
        self.level, self._warm = level, warm
        self._mine = threading.local()
        self._all, self._lock = [], threading.Lock()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def start(self, exercise):
        """A fresh worker.

        Parameters
        ----------
        exercise : Exercise

        Returns
        -------
        Forked or Fresh

        Raises
        ------
        CannotStart
        """
        if not FORKS:
            return Fresh(exercise)
        try:
            try:
                return self._zygote(exercise).fork()
            except Broken:  # perhaps what it had forked broke it: once more
                return self._zygote(exercise).fork()
        except Broken as error:
            raise CannotStart(f"the worker did not start: {error}") from None

    def close(self):
        """End every zygote and worker; may be called twice."""
        with self._lock:
            ended, self._all = self._all, []
        for zygote in ended:
            zygote.close()

    def _zygote(self, exercise):
        known = vars(self._mine).setdefault("zygotes", {})
        kind = exercise.drives, exercise.allows
        zygote = known.get(kind)
        if zygote is None or not zygote.alive:
            zygote = known[kind] = Zygote(exercise, self.level, self._warm)
            with self._lock:
                self._all.append(zygote)
        return zygote
