"""Running an estimator over a source, the naive trajectory kept beside it."""

import time
from dataclasses import dataclass

import numpy as np

from slamlab.estimators.base import Estimator
from slamlab.geometry import compose
from slamlab.readings import Trajectory
from slamlab.sources.base import Source


@dataclass(frozen=True)
class Run:
    """What came of a run.

    Parameters
    ----------
    source : Source
    estimator : Estimator, after its last step
    trajectory : Trajectory as the estimator believes it at the end
    naive : Trajectory by odometry alone
    frames : int, readings taken in
    skipped : int, readings lost to damage or without a usable scan
    seconds : float, wall-clock time [s]
    """

    source: Source
    estimator: Estimator
    trajectory: Trajectory
    naive: Trajectory
    frames: int
    skipped: int
    seconds: float


def run(source, estimator, on_step=None):
    """Feed all readings of a source to an estimator.

    Parameters
    ----------
    source : Source
    estimator : Estimator
    on_step : callable(reading, estimator) or None, called after each step

    Returns
    -------
    Run
    """
    start, naive, times, poses = time.perf_counter(), np.zeros(3), [], []
    for reading in source:
        naive = compose(naive, reading.odometry)
        times.append(reading.time)
        poses.append(naive)
        estimator.step(reading)
        if on_step is not None:
            on_step(reading, estimator)
    return Run(
        source=source,
        estimator=estimator,
        trajectory=estimator.trajectory(),
        naive=Trajectory(np.array(times), np.array(poses).reshape(-1, 3)),
        frames=len(times),
        skipped=source.skipped + estimator.skipped,
        seconds=time.perf_counter() - start,
    )
