"""The published scale: points of a run, from 0 (odometry) to 100, by linear interpolation.

Each metric is a gain over odometry on the same readings. A run as good as odometry gets 0 points, a
run as good as ``icp`` gets 55, and a run as good as ``graph`` gets 85. A run with errors a fifth
below those of ``graph`` gets 100 points."""

from dataclasses import dataclass

import numpy as np

from classroom.project import estimate_errors
from classroom.project.estimate_errors import LENGTHS
from slamlab.evaluation.consistency import band
from slamlab.geometry import transform

MARKS = 0.0, 55.0, 85.0, 100.0  # points of odometry, icp, graph, and of the target
MAP_SHARE = 0.2  # of the points; the rest is for the trajectory [1]
FLOOR = 0.005  # smaller errors hardly raise the gain [m]
FIRST_GAIN, NEXT_GAIN = np.log(1.5), np.log(1.35)  # least distances of marks: see ``marks``
BEYOND = np.log(1.25)  # for 100 points: errors smaller than those of graph by this factor
MAP_GAIN = 0.2  # least distance between the map marks of odometry and graph [1]
MAX_PENALTY = 20.0  # points lost for a covariance that is wrong by a factor of 100 or more
NEES_BAND = band(3, 1)
"""Interval of the mean NEES of a run with consistent covariances. The errors of a run are
correlated, so the run counts as a single draw."""


@dataclass(frozen=True)
class Metrics:
    """The metrics of a run.

    relations : mean error of the relations of a log [m]; a log's map, errors and nees are NaN."""

    gain: float  # mean log ratio of the errors of odometry to its own, over 1, 5 and 20 m [1]
    errors: np.ndarray  # (3,) mean relative errors over these lengths [m]
    map: float  # map score [1]
    completeness: float  # share of finite poses [1]
    nees: float  # mean NEES; NaN without covariances [1]
    relations: float = np.nan


def measure(run, world, odometry, walls):
    """Compute a run's metrics against ground truth; missing poses get the errors of odometry.

    odometry : EstimatorRun of odometry on the same world. walls : result of
    ``estimate_errors.walls_to_map``."""
    truth, gains, means = world.truth.poses, [], []
    for length in LENGTHS:
        errors, of_odometry = (
            estimate_errors.relative_errors(poses, truth, world.metres, length)
            for poses in (run.trajectory, odometry.trajectory)
        )
        gain, mean = _gain(errors, of_odometry)
        gains.append(gain)
        means.append(mean)
    motion = estimate_errors.aligned(run.trajectory, truth)
    return Metrics(
        float(np.mean(gains)),
        np.array(means),
        estimate_errors.map_score(transform(motion, run.points), *walls),
        run.completeness,
        estimate_errors.mean_nees(run.online, run.covariances, truth),
    )


def compute_log_metrics(run, log, odometry):
    """Compute the metrics of a run on a RecordedLog from the log's relations."""
    gain, mean = _gain(log.errors(run.trajectory), log.errors(odometry.trajectory))
    unknown = np.full(len(LENGTHS), np.nan)
    return Metrics(gain, unknown, np.nan, run.completeness, np.nan, mean)


def _gain(errors, of_odometry):
    """Return gain over odometry and mean error [m]; odometry's errors replace non-finite ones."""
    errors = np.where(np.isfinite(errors), errors, of_odometry)
    gain = np.mean(np.log((of_odometry + FLOOR) / (errors + FLOOR)))
    return float(gain), float(errors.mean())


def marks(odometry, icp, graph):
    """Return (4,) gains and (4,) map scores that are worth 0, 55, 85 and 100 points, ascending.

    Each mark has a minimum distance from the previous one, so that a lucky run of a baseline does
    not make a small error worth many points."""
    middle = max(icp.gain, FIRST_GAIN)
    high = max(graph.gain, middle + NEXT_GAIN)
    gains = np.array([0.0, middle, high, high + BEYOND])
    better = max(graph.map - odometry.map, MAP_GAIN)
    maps = odometry.map + better * np.array(MARKS) / MARKS[2]
    maps[3] = min(maps[3], max(1.0, maps[2] + 0.01))  # a perfect map gets all points
    return gains, maps


def points_of(measures, scale):
    """Compute the points of a run, 0 to 100, on a scale of :func:`marks`.

    points = completeness · (0.8 · trajectory + 0.2 · min(map, trajectory)) − penalty of the
    covariance. Without a map score, points = completeness · trajectory."""
    gains, maps = scale
    track = np.interp(measures.gain, gains, MARKS)
    # a map gets no more points than the trajectory: pieces of a map by odometry gain nothing
    known = np.isfinite(measures.map)
    mapped = min(np.interp(measures.map, maps, MARKS), track) if known else track
    good = (1 - MAP_SHARE) * track + MAP_SHARE * mapped
    return float(max(0.0, measures.completeness * good - inconsistency_penalty(measures.nees)))


def inconsistency_penalty(nees):
    """NEES test against its chi-squared interval: points lost for an inconsistent covariance.

    The penalty is 0 if the mean NEES is in the interval or NaN. Otherwise, the penalty is
    proportional to the logarithm of the ratio between the mean NEES and the nearest bound, up to
    MAX_PENALTY."""
    if np.isnan(nees):
        return 0.0
    low, high = NEES_BAND
    off = max(np.log(low / max(nees, 1e-9)), np.log(nees / high) if nees > 0 else 0.0, 0.0)
    return MAX_PENALTY * min(1.0, off / np.log(100))
