"""Run an estimator on a world's readings within a budget of CPU time, and store the results."""

import time
from collections.abc import Callable
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass
from functools import partial

import numpy as np

from classroom.exercises.function_calls import StudentError
from classroom.exercises.function_calls.student_estimator import StudentEstimator
from classroom.exercises.time_limit import TimeLimitExceeded

USED_UP = (
    "the {:g} s of CPU time for all worlds are used up: limit the size of everything that grows "
    "with each reading, such as the map for matching or the graph"
)
WAITED = "{:g} s have passed, and the CPU was mostly idle: does the estimator wait or sleep?"
NOT_FINITE = (
    "{} of {} poses are not finite or are farther away than 1000 km: is there a division by zero, "
    "or does the pose diverge?"
)
GUARD_LATER = 0.1  # delay of the guard after the limit, so that the limit is reported [s]
TOO_LONG = "{} took {:.1f} s of CPU time; the limit is {:g} s"


@dataclass
class Budget:
    """The CPU time that one estimator may use.

    ``patience`` limits wall-clock time, to stop an estimator that neither computes nor ends."""

    total: float = 50.0  # for all worlds together [s]
    reading: float = 1.0  # for a single step [s]
    ending: float = 5.0  # for trajectory() and map() at the end of a world [s]
    patience: float = 600.0  # of the wall clock, for all worlds together [s]
    clock: Callable[[], float] = time.process_time
    wall_clock: Callable[[], float] = time.monotonic
    guard: Callable = nullcontext  # (seconds) -> context that ends what runs longer
    spent: float = 0.0  # of CPU so far [s]
    waited: float = 0.0  # of the wall clock so far [s]

    def timed(self, function, limit, what):
        """Call a function within a limit [s] and count its time. Raises StudentError."""
        self._check()
        start, begun, ended = self.clock(), self.wall_clock(), False
        try:
            with self.guard(limit + GUARD_LATER):
                return function()
        except TimeLimitExceeded:
            ended = True  # the timer and this clock may differ
        finally:
            took = self.clock() - start
            self.spent += took
            self.waited += self.wall_clock() - begun
            if ended or took > limit:
                message = TOO_LONG.format(what, max(took, limit), limit)
                raise StudentError("time", message) from None
            self._check()

    def _check(self):
        if self.spent > self.total:
            raise StudentError("time", USED_UP.format(self.total)) from None
        if self.waited > self.patience:
            raise StudentError("time", WAITED.format(self.patience)) from None


@dataclass(frozen=True)
class EstimatorRun:
    """The results of an estimator in one world; NaN where a result is missing."""

    online: np.ndarray  # (n, 3) the pose right after each reading [m, m, rad]
    covariances: np.ndarray  # (n, 3, 3) of these poses
    trajectory: np.ndarray  # (n, 3) all poses as estimated at the end [m, m, rad]
    points: np.ndarray  # (m, 2) its map [m]
    mistakes: tuple[str, ...]  # messages about errors
    seconds: float  # CPU time
    late: bool = False  # whether a time limit ended it, which may differ on another machine

    @property
    def completeness(self):
        """Share of the readings with a finite pose in the final trajectory [1]."""
        return float(np.isfinite(self.trajectory).all(axis=1).mean())


def run_estimator(make, world, budget=None):
    """Run an estimator on a world; an error ends the run on this world only.

    make : the student's class. world : sized iterable of Reading."""
    budget, n, mistakes = budget or Budget(), len(world), []
    before, answered, late = budget.spent, 0, False
    online, covariances = np.full((n, 3), np.nan), np.full((n, 3, 3), np.nan)
    trajectory, points = online, np.empty((0, 2))
    try:
        estimator = budget.timed(lambda: StudentEstimator(make), budget.ending, "creating it")
        for reading in world:
            step = budget.timed(partial(estimator.step, reading), budget.reading, "step")
            online[answered], covariances[answered] = step
            answered += 1
    except StudentError as error:
        mistakes.append(f"at reading {answered + 1} of {n}: {error.message}")
        late = error.kind == "time"
    else:
        # the map is requested even if the trajectory fails
        with _kept(mistakes):
            ask = partial(estimator.trajectory, n)
            offered = budget.timed(ask, budget.ending, "trajectory()")
            trajectory = online if offered is None else offered
        with _kept(mistakes):
            points = budget.timed(estimator.map, budget.ending, "map()")
    lost = int(np.isnan(trajectory[:answered]).any(axis=1).sum())
    if lost:
        mistakes.append(NOT_FINITE.format(lost, n))
    spent = budget.spent - before
    return EstimatorRun(online, covariances, trajectory, points, tuple(mistakes), spent, late)


@contextmanager
def _kept(mistakes):
    try:
        yield
    except StudentError as error:
        mistakes.append(error.message)
