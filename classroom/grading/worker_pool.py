"""Worker pool: start workers, forked from a zygote on Linux and spawned elsewhere."""

import sys
import threading

from classroom.grading import sandbox
from classroom.grading.forked_workers import MAGICS_MODULE, PRELOADED, Zygote, ZygoteError
from classroom.grading.spawned_workers import SpawnedWorker

CAN_FORK = sys.platform == "linux"
"""On macOS a fork is unsafe after Apple's libraries were used; Windows has no fork."""


class WorkerStartError(Exception):
    """A worker could not be started, or grading was stopped; the student is not the cause."""


class WorkerPool:
    """Starts workers at an isolation level, from one zygote (fork server) for each exercise and
    thread. If ``warm``, zygotes first import ``preload``.
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
        """Start a new ForkedWorker or SpawnedWorker. Raises WorkerStartError."""
        if not CAN_FORK:
            return SpawnedWorker(exercise)
        try:
            try:
                return self._zygote(exercise).fork()
            except ZygoteError:  # perhaps an earlier worker broke the zygote: try once more
                return self._zygote(exercise).fork()
        except ZygoteError as error:
            raise WorkerStartError(f"the worker did not start: {error}") from None

    def close(self):
        """End all zygotes of the pool; a second call has no effect."""
        with self._lock:
            ended, self._all = self._all, []
        for zygote in ended:
            zygote.close()

    def _zygote(self, exercise):
        known = vars(self._mine).setdefault("zygotes", {})
        kind = exercise.calls, exercise.allows, exercise.hides
        zygote = known.get(kind)
        if zygote is None or not zygote.alive:
            zygote = known[kind] = Zygote(exercise, self.level, *self._imports)
            with self._lock:
                self._all.append(zygote)
        return zygote
