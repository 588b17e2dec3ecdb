"""Running of an estimator over a source."""

import time
from collections.abc import Iterable
from dataclasses import dataclass

from slamlab.estimators.base import Estimator
from slamlab.estimators.odometry_check import OdometryCheck
from slamlab.readings import Reading, Trajectory


@dataclass(frozen=True)
class Run:
    """The result of running an estimator over a source.

    Parameters
    ----------
    source : Source
    estimator : Estimator, after its last step
    trajectory : Trajectory, as estimated at the end
    naive : Trajectory by odometry alone, without jumps; None without odometry
    frames : int, processed readings
    skipped : int, damaged readings, or readings without a usable scan
    seconds : float, wall-clock time [s]
    warnings : list of str, disagreements of odometry and scans
    """

    source: Iterable[Reading]
    estimator: Estimator
    trajectory: Trajectory
    naive: Trajectory | None
    frames: int
    skipped: int
    seconds: float
    warnings: list[str]


def run(source, estimator, on_step=None):
    """Run an estimator over all readings of a source. Returns a Run.

    Parameters
    ----------
    source : Source
    estimator : Estimator
    on_step : callable(reading, estimator) or None, called after each step
    """
    start, frames, odometry = time.perf_counter(), 0, OdometryCheck(source.sensor)
    for reading in source:
        frames += 1
        odometry.step(reading)
        estimator.step(reading)
        if on_step is not None:
            on_step(reading, estimator)
    return Run(
        source=source,
        estimator=estimator,
        trajectory=estimator.trajectory(),
        naive=odometry.trajectory() if odometry.has_odometry else None,
        frames=frames,
        skipped=source.skipped + estimator.skipped,
        seconds=time.perf_counter() - start,
        warnings=odometry.warnings,
    )
