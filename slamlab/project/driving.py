"""Driving: an estimator is fed a world's readings one at a time, and what it answers is kept."""

import time
from collections.abc import Callable
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass
from functools import partial

import numpy as np

from slamlab.exercises.drives import StudentError
from slamlab.exercises.drives.student_estimator import StudentEstimator
from slamlab.exercises.time_limit import TimeLimitExceeded

USED_UP = (
    "the {:g} s of CPU for all worlds are used up: what grows with every reading, a map to match "
    "with or a graph to solve, has to be kept small"
)
WAITED = "{:g} s have passed in all, the CPU mostly idle: does it wait or sleep?"
NOT_FINITE = (
    "{} of {} poses are not finite, or farther away than 1000 km: was something divided by zero, "
    "or does the pose run off?"
)
GUARD_LATER = 0.1  # than the limit, which is told then [s]
TOO_LONG = "{} took {:.1f} s of CPU, more than the {:g} s that are allowed"


@dataclass
class Budget:
    """The seconds that one estimator may use: the same for all, and told beforehand.

    They are seconds of CPU: who waits for a processor uses none, though on a crowded one the same
    work takes up to twice as many. What neither works nor ends is stopped by ``patience``, the only
    seconds of a wall clock.

    Parameters
    ----------
    total : float, for all worlds together [s]
    reading : float, for a single step [s]
    ending : float, for ``trajectory()`` and ``map()`` at the end of a world [s]
    patience : float, of the wall clock, for all worlds together [s]
    clock : callable that gives CPU seconds
    wall_clock : callable that gives seconds
    guard : callable(seconds) -> context that ends what runs longer, as ``time_limit`` does; where
        nobody else ends it
    spent, waited : float, what was used so far, of CPU and of the wall clock [s]
    """

    total: float = 50.0
    reading: float = 1.0
    ending: float = 5.0
    patience: float = 600.0
    clock: Callable[[], float] = time.process_time
    wall_clock: Callable[[], float] = time.monotonic
    guard: Callable = nullcontext
    spent: float = 0.0
    waited: float = 0.0

    def timed(self, function, limit, what):
        """Call a function and count its time.

        Parameters
        ----------
        function : callable without arguments
        limit : float [s]
        what : str, what it is, for the message

        Returns
        -------
        what the function returns

        Raises
        ------
        StudentError : it took too long, or all of the budget is spent
        """
        self._check()
        start, begun, ended = self.clock(), self.wall_clock(), False
        try:
            with self.guard(limit + GUARD_LATER):
                return function()
        except TimeLimitExceeded:
            ended = True  # its timer and this clock do not tick alike
        finally:
            took = self.clock() - start
            self.spent += took
            self.waited += self.wall_clock() - begun
            if ended or took > limit:
                told = TOO_LONG.format(what, max(took, limit), limit)
                raise StudentError("time", told) from None
            self._check()

    def _check(self):
        if self.spent > self.total:
            raise StudentError("time", USED_UP.format(self.total)) from None
        if self.waited > self.patience:
            raise StudentError("time", WAITED.format(self.patience)) from None


@dataclass(frozen=True)
class Drive:
    """What an estimator answered in one world.

    Parameters
    ----------
    online : (n, 3) the pose given right after each reading; NaN where there was none [m, m, rad]
    covariances : (n, 3, 3) claimed beside it; NaN where none was
    trajectory : (n, 3) all poses as believed at the end; NaN where there is none [m, m, rad]
    points : (m, 2) its map [m]
    mistakes : tuple of str, what went wrong, a sentence each
    seconds : float of CPU
    late : bool, whether a limit of time ended it: what another machine may not find
    """

    online: np.ndarray
    covariances: np.ndarray
    trajectory: np.ndarray
    points: np.ndarray
    mistakes: tuple[str, ...]
    seconds: float
    late: bool = False

    @property
    def completeness(self):
        """Share of the readings with a finite pose in the end [1]."""
        return float(np.isfinite(self.trajectory).all(axis=1).mean())


def drive(make, world, budget=None):
    """Drive an estimator through a world; whatever it does wrong ends this world, no more.

    Parameters
    ----------
    make : callable that makes the student's estimator, its class
    world : sized iterable of Reading; each is made when it is asked for
    budget : Budget, or None for a new one

    Returns
    -------
    Drive
    """
    budget, n, mistakes = budget or Budget(), len(world), []
    before, answered, late = budget.spent, 0, False
    online, covariances = np.full((n, 3), np.nan), np.full((n, 3, 3), np.nan)
    trajectory, points = online, np.empty((0, 2))
    try:
        estimator = budget.timed(lambda: StudentEstimator(make), budget.ending, "making it")
        for reading in world:
            step = budget.timed(partial(estimator.step, reading), budget.reading, "step")
            online[answered], covariances[answered] = step
            answered += 1
    except StudentError as error:
        mistakes.append(f"at reading {answered + 1} of {n}: {error.message}")
        late = error.kind == "time"
    else:
        # the map is asked for though the trajectory fails
        with _kept(mistakes):
            ask = partial(estimator.trajectory, n)
            told = budget.timed(ask, budget.ending, "trajectory()")
            trajectory = online if told is None else told
        with _kept(mistakes):
            points = budget.timed(estimator.map, budget.ending, "map()")
    lost = int(np.isnan(trajectory[:answered]).any(axis=1).sum())
    if lost:
        mistakes.append(NOT_FINITE.format(lost, n))
    spent = budget.spent - before
    return Drive(online, covariances, trajectory, points, tuple(mistakes), spent, late)


@contextmanager
def _kept(mistakes):
    try:
        yield
    except StudentError as error:
        mistakes.append(error.message)
