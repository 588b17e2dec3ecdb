"""Pool of judge processes, because a judge needs as much CPU time as its worker. The
processes are forked before threads start and the gradebook is opened, because forking later is
unsafe. A single judge runs in the current process.
"""

import contextlib
import ctypes
import functools
import gc
import multiprocessing
import os
import queue
import signal
import threading

from classroom.grading import judge
from classroom.grading.worker_pool import CAN_FORK
from slamlab.parallel import RunError

PARENT_DEATH_SIGNAL = 1  # prctl: what the kernel sends to a child whose parent was killed
LOST = (
    "a judge process was killed, possibly because memory ran out. The gradebook's contents are "
    "safe. Run the same command again to continue (--jobs 1 needs less memory)"
)


class JudgePool:
    """A pool of ``count`` judges; each thread uses one judge at a time."""

    def __init__(self, count, secret, workers, default=None):
        self.count, self._workers = count, workers
        self._grade = functools.partial(judge.grade_submission, secret=secret, default=default)
        self._stop, self._processes = threading.Event(), []
        self._free = queue.LifoQueue()  # so that a single thread always gets the same judge
        for _ in range(count if CAN_FORK and count > 1 else 0):
            process = _Process(self._grade, workers, [p.connection for p in self._processes])
            self._processes.append(process)
            self._free.put(process)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.stop()
        self.close()

    def grade(self, submission, known=None):
        """See :func:`judge.grade_submission`. Raises RunError if the judge's process was killed."""
        if not self._processes:
            return self._grade(submission, workers=self._workers, known=known, stop=self._stop)
        process = self._free.get()
        try:
            return process.ask(submission, known)
        finally:
            self._free.put(process)

    def stop(self):
        """Stop grading; submissions in progress are soon returned as failed."""
        self._stop.set()
        for process in self._processes:
            process.stop()

    def close(self):
        """End the judges, which must be idle; a second call has no effect."""
        ended, self._processes = self._processes, []
        for process in ended:
            process.close()
        self._workers.close()


class _Process:
    """A judge process; ``others`` are connections that the process must close."""

    def __init__(self, grade, workers, others):
        forking = multiprocessing.get_context("fork")
        self.connection, theirs = forking.Pipe()
        self._process = forking.Process(
            target=_serve,
            args=(theirs, [self.connection, *others], grade, workers, os.getpid()),
            daemon=True,
        )
        self._process.start()
        theirs.close()

    def ask(self, submission, known):
        try:
            self.connection.send((submission, known))
            return self.connection.recv()
        except (EOFError, OSError):
            raise RunError(LOST) from None

    def stop(self):
        if self._process.is_alive():
            self._process.terminate()

    def close(self):
        self.connection.close()
        self._process.join()


def _serve(connection, others, grade, workers, parent):
    """Grade received submissions until the connection closes; SIGTERM ends all waiting."""
    stop = threading.Event()
    signal.signal(signal.SIGTERM, lambda *_: stop.set())
    for name in ("SIGINT", "SIGHUP"):  # the parent process handles signals from the terminal
        signal.signal(getattr(signal, name), signal.SIG_IGN)
    ctypes.CDLL(None).prctl(PARENT_DEATH_SIGNAL, signal.SIGTERM, 0, 0, 0)
    for other in others:
        other.close()
    gc.freeze()  # a garbage collection would write to all memory pages shared with the parent
    with workers, contextlib.suppress(EOFError, OSError):
        while os.getppid() == parent:
            submission, known = connection.recv()
            connection.send(grade(submission, workers=workers, known=known, stop=stop))
