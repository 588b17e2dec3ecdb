"""Run a student's estimator in the sandbox, in a new worker for each hidden world.

A worker answers before the next reading is generated. The worker contains no ground truth, no seed
and no other world. The kernel measures the CPU time of the worker."""

import functools
import re
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from classroom.exercises import catalogue
from classroom.exercises.function_calls import FunctionCall, StudentError
from classroom.exercises.function_calls.student_estimator import GraderFault
from classroom.exercises.references import NO_REFERENCES
from classroom.grading.forked_workers import ZygoteError
from classroom.grading.worker_client import WorkerClient
from classroom.grading.worker_pool import WorkerStartError
from classroom.project.estimator_runs import run_estimator
from classroom.project.estimator_worker import CALLS, arrays_of

MAX_CELLS = 5  # failed cells that are reported: with definitions, or all if there is no pose
_DEFINES = re.compile(r"^(class|def)\s", re.MULTILINE)


@functools.cache
def project():
    """Return the Exercise whose worker runs an estimator on hidden worlds."""
    exercise = catalogue.exercise("16")
    return replace(exercise, tasks=(), calls="classroom.project.estimator_worker")


@dataclass(frozen=True)
class _Request:
    """A message to the worker: the name of a function and its arguments."""

    id: str
    call: FunctionCall


class RemoteEstimator:
    """A student's estimator in a worker, with the same interface as the student's class.

    Raises StudentError, GraderFault."""

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
        self._count += 1
        self.pose, P = self._ask("step", arrays_of(reading), "pose", "covariance")
        self.covariance = None if np.all(np.isnan(P)) else P

    def _trajectory(self):
        return self._ask("trajectory", {"count": np.array(self._count)}, "trajectory")

    def _map(self):
        return self._ask("map", {}, "points")

    def _ask(self, request, inputs, *names):
        try:
            task = _Request(request, CALLS[request])
            answers = self._client.run(task, {"": inputs}, NO_REFERENCES)[""]
        except (StudentError, GraderFault):
            raise
        except WorkerStartError as error:
            raise GraderFault(str(error)) from error
        except Exception as error:  # in this process, so not an error of the student
            raise GraderFault(f"{type(error).__name__}: {error}") from error
        if any(name not in answers for name in names):
            raise StudentError("malformed", f"{request}: no valid answer was received")
        found = [answers[name] for name in names]
        return found if len(found) > 1 else found[0]


def run_in_sandbox(cells, readings, start, budget, stop=None):
    """Run a student's class from (number, source) cells on one world. Raises GraderFault.

    The worker's whole CPU time counts. budget : Budget for all worlds. stop : Event, or None."""
    with WorkerClient(project(), cells, start, stop, unredacted=True) as client:
        budget.clock = client.cpu_so_far
        try:
            run = run_estimator(partial(RemoteEstimator, client), readings, budget)
        except ZygoteError as error:
            raise GraderFault(str(error)) from error
    # a failed cell may leave an older definition of the class, which runs without an error
    nothing = run.mistakes and not np.isfinite(run.online).any()
    sources = dict(cells)
    failed = [
        f"cell {number}: {problem}"
        for number, problem in client.problems.items()
        if nothing or _DEFINES.search(sources.get(number, ""))
    ]
    return replace(run, mistakes=(*run.mistakes, *failed[:MAX_CELLS]))
