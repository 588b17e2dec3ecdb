"""Worker pool: starts sandboxed workers, forked from a zygote on Linux, else spawned."""

import sys
import threading

from slamlab.grading import sandbox
from slamlab.grading.forked_workers import MAGICS_MODULE, PRELOADED, Zygote, ZygoteError
from slamlab.grading.fresh_workers import FreshWorker

CAN_FORK = sys.platform == "linux"
"""On macOS a fork after Apple's libraries were used is unsafe, on Windows there is none."""


class WorkerStartError(Exception):
    """A worker could not be started, or grading was stopped: no fault of the student's."""


class WorkerPool:
    """Pool that starts workers; it keeps a zygote (fork server) for each exercise and thread.

    Parameters
    ----------
    level : str, one of ``sandbox.LEVELS``; sandboxed workers exist on Linux only
    warm : bool, whether many are to come, so that importing beforehand pays
    preload : names of modules to import then, such as :func:`forked_workers.named_modules` tells
    """

    def __init__(self, level=sandbox.NONE, warm=True, preload=(*PRELOADED, MAGICS_MODULE)):
        self.level, self._imports = level, (warm, tuple(preload))
        self._mine = threading.local()
        self._all, self._lock = [], threading.Lock()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def start(self, exercise):
        """Start a fresh worker.

        Parameters
        ----------
        exercise : Exercise

        Returns
        -------
        ForkedWorker or FreshWorker

        Raises
        ------
        WorkerStartError
        """
        if not CAN_FORK:
            return FreshWorker(exercise)
        try:
            try:
                return self._zygote(exercise).fork()
            except ZygoteError:  # perhaps what it had forked broke it: once more
                return self._zygote(exercise).fork()
        except ZygoteError as error:
            raise WorkerStartError(f"the worker did not start: {error}") from None

    def close(self):
        """Terminate every zygote and worker; may be called twice."""
        with self._lock:
            ended, self._all = self._all, []
        for zygote in ended:
            zygote.close()

    def _zygote(self, exercise):
        known = vars(self._mine).setdefault("zygotes", {})
        kind = exercise.drives, exercise.allows, exercise.hides
        zygote = known.get(kind)
        if zygote is None or not zygote.alive:
            zygote = known[kind] = Zygote(exercise, self.level, *self._imports)
            with self._lock:
                self._all.append(zygote)
        return zygote
