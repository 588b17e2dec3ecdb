"""Run an estimator over a source (dataset), with the naive (odometry-only) trajectory beside."""

import time
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from slamlab.estimators.base import Estimator
from slamlab.estimators.odometry_jumps import odometry_anomaly
from slamlab.geometry import compose
from slamlab.readings import Reading, Trajectory


@dataclass(frozen=True)
class Run:
    """The result of a run: trajectories, counts and run time.

    Parameters
    ----------
    source : Source
    estimator : Estimator, after its last step
    trajectory : Trajectory as the estimator believes it at the end
    naive : Trajectory by odometry alone, without its jumps
    frames : int, readings taken in
    skipped : int, readings lost to damage or without a usable scan
    seconds : float, wall-clock time [s]
    """

    source: Iterable[Reading]
    estimator: Estimator
    trajectory: Trajectory
    naive: Trajectory
    frames: int
    skipped: int
    seconds: float


def run(source, estimator, on_step=None):
    """Run an estimator over all readings of a source.

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
        if not odometry_anomaly(reading.odometry):
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
