"""Judges that work at once: processes of their own, as a judge computes as much as its worker.

They are forked before there is a thread or an opened gradebook, neither of which a fork copies
well. One judge alone, and all where none can be forked (macOS, Windows), judge in this process.
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

from slamlab.grading import judge
from slamlab.grading.worker_pool import CAN_FORK
from slamlab.parallel import RunError

PARENT_DEATH_SIGNAL = 1  # prctl: what the kernel sends to a child whose parent was killed
LOST = (
    "a judge's process was ended from outside, perhaps as the memory was full; what the gradebook "
    "holds is safe, and the same command goes on from there (--jobs 1 takes less memory)"
)


class Judges:
    """Judges of a class; each thread that asks for a record has one for itself meanwhile.

    Parameters
    ----------
    count : int, how many work at once
    secret : bytes
    workers : WorkerPool
    default : str or None, the exercise that all are to be of
    """

    def __init__(self, count, secret, workers, default=None):
        self.count, self._workers = count, workers
        self._grade = functools.partial(judge.grade_submission, secret=secret, default=default)
        self._stop, self._processes = threading.Event(), []
        self._free = queue.LifoQueue()  # so that one at a time is always the same one
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
        """The record of one submission.

        Parameters
        ----------
        submission : Submission
        known : attempt's key to Record, which are not graded again

        Returns
        -------
        Record

        Raises
        ------
        RunError : its process was killed
        """
        if not self._processes:
            return self._grade(submission, workers=self._workers, known=known, stop=self._stop)
        process = self._free.get()
        try:
            return process.ask(submission, known)
        finally:
            self._free.put(process)

    def stop(self):
        """Let nothing be waited for any more: what is being graded comes back as failed, soon."""
        self._stop.set()
        for process in self._processes:
            process.stop()

    def close(self):
        """End all workers and judges; nobody may be asking. May be called twice."""
        ended, self._processes = self._processes, []
        for process in ended:
            process.close()
        self._workers.close()


class _Process:
    """A judge in a process of its own; others are connections that it has no part in."""

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
    """Grade what is sent, until nobody listens; SIGTERM ends the waiting for what hangs."""
    stop = threading.Event()
    signal.signal(signal.SIGTERM, lambda *_: stop.set())
    for name in ("SIGINT", "SIGHUP"):  # who is at the terminal means the command as a whole
        signal.signal(getattr(signal, name), signal.SIG_IGN)
    ctypes.CDLL(None).prctl(PARENT_DEATH_SIGNAL, signal.SIGTERM, 0, 0, 0)
    for other in others:
        other.close()
    gc.freeze()  # a collection would write to every page that is shared until then
    with workers, contextlib.suppress(EOFError, OSError):
        while os.getppid() == parent:
            submission, known = connection.recv()
            connection.send(grade(submission, workers=workers, known=known, stop=stop))
