"""Judging in the sandbox: hidden worlds, one after the other, each in a worker of its own.

A worker is handed one reading a message and answers before the next is made, so nobody looks
ahead; no truth, no seed and no other world is ever in it. What comes back are arrays, checked again
here. Its CPU time is the kernel's, not the worker's word.
"""

import re
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from slamlab.exercises.drives import Drive, StudentError
from slamlab.exercises.drives.student_estimator import GraderFault
from slamlab.exercises.tasks.ex16 import EXERCISE
from slamlab.grading.forked_workers import ZygoteError
from slamlab.grading.worker_client import WorkerClient
from slamlab.grading.worker_pool import WorkerStartError
from slamlab.project.driving import drive
from slamlab.project.reading_arrays import arrays_of
from slamlab.project.streamed_drive import DRIVES

PROJECT = replace(EXERCISE, tasks=(), drives="slamlab.project.streamed_drive")
"""What a worker holds that drives through hidden worlds, and what never."""
MAX_CELLS = 5  # that failed are told: those that define something, or all where nothing drives
_DEFINES = re.compile(r"^(class|def)\s", re.MULTILINE)


@dataclass(frozen=True)
class _Request:
    """A message to the worker, by the name of one of its drives."""

    id: str
    drive: Drive


class RemoteEstimator:
    """An estimator in a worker, with the interface of a student's class.

    Parameters
    ----------
    client : WorkerClient, with the student's cells

    Raises
    ------
    StudentError : the student's class cannot be made
    GraderFault
    """

    covariance = None

    def __init__(self, client):
        self._client, self._count = client, 0
        self.pose = np.full(3, np.nan)
        offers = np.ravel(self._ask("begin", {}, "offers"))
        if offers[:1].any():
            self.trajectory = self._trajectory
        if offers[1:].any():
            self.map = self._map

    def step(self, reading):
        """Send it a reading, and keep what it answers."""
        self._count += 1
        self.pose, P = self._ask("step", arrays_of(reading), "pose", "covariance")
        self.covariance = None if np.all(np.isnan(P)) else P

    def _trajectory(self):
        return self._ask("trajectory", {"count": np.array(self._count)}, "trajectory")

    def _map(self):
        return self._ask("map", {}, "points")

    def _ask(self, request, inputs, *names):
        try:
            answers = self._client.run(_Request(request, DRIVES[request]), {"": inputs})[""]
        except (StudentError, GraderFault):
            raise
        except WorkerStartError as error:
            raise GraderFault(str(error)) from error
        except Exception as error:  # here, not in the worker: no fault of the student's
            raise GraderFault(f"{type(error).__name__}: {error}") from error
        if any(name not in answers for name in names):
            raise StudentError("malformed", f"{request}: no answer came back that can be judged")
        found = [answers[name] for name in names]
        return found if len(found) > 1 else found[0]


def drive_in_sandbox(cells, readings, start, budget, stop=None):
    """Drive a student's class through one world, in a worker of its own.

    All that the worker takes counts: running the cells, too.

    Parameters
    ----------
    cells : list of (number, source), the student's code cells in order
    readings : sized iterable of Reading
    start : exercise -> worker, such as ``WorkerPool.start``
    budget : Budget, shared by all worlds of the student
    stop : threading.Event or None; once it is set, nothing is waited for any more

    Returns
    -------
    Drive

    Raises
    ------
    GraderFault : no worker could be had, or judging was stopped
    """
    with WorkerClient(PROJECT, cells, start, stop, unredacted=True) as client:
        budget.clock = client.cpu_so_far
        try:
            driven = drive(partial(RemoteEstimator, client), readings, budget)
        except ZygoteError as error:
            raise GraderFault(str(error)) from error
    # a cell that failed may have left an older class in its place, which drives without a word
    nothing = driven.mistakes and not np.isfinite(driven.online).any()
    sources = dict(cells)
    told = [
        f"cell {number}: {problem}"
        for number, problem in client.problems.items()
        if nothing or _DEFINES.search(sources.get(number, ""))
    ]
    return replace(driven, mistakes=(*driven.mistakes, *told[:MAX_CELLS]))
