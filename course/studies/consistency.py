"""``python -m course.studies.consistency``: consistency (NEES) of EKF-SLAM over Monte Carlo runs.

Each row is for one filter; all filters process the same readings. The filters use standard
Jacobians, first-estimates Jacobians, or Jacobians evaluated at the truth (the ideal filter).
"""

import sys
from dataclasses import asdict, fields
from functools import partial

import numpy as np

from course.studies.ideal_ekf_slam import IdealEkfSlam
from course.studies.study_command import (
    TABLES,
    first_runs,
    package_versions,
    parser,
    rounded,
    seeds,
    write,
)
from slamlab.estimators.ekf_slam import EkfSlam, Q_arc
from slamlab.evaluation import band, consistency, nees
from slamlab.geometry import compose, wrap
from slamlab.parallel import map_runs
from slamlab.sources.landmark_runs import LandmarkRun, Loop

FILTERS = ("ideal", "first estimates", "standard")  # where Jacobians are evaluated
BURN_IN = 10  # steps left out, until the pose's covariance, zero at first, can be inverted safely
LAST_STEPS = 100  # steps over which the final NEES is averaged
TABLE = TABLES / "consistency.json"


def errors_of(seed, loop, filters=FILTERS):
    """Return for each of the ``filters`` the errors (steps, 3), P (steps, 3, 3) and the mean square
    landmark error [m²]."""
    source = LandmarkRun(loop, np.random.default_rng(seed))
    return {
        name: _summary(source, *(_ideal(source) if name == "ideal" else _mak(source, name)))
        for name in filters
    }


def _mak(source, name):
    slam, P = EkfSlam(source.robot, source.sensor, name == "first estimates"), []
    for reading in source:
        slam.step(reading)
        P.append(slam.filter.block([0, 1, 2]))
    return slam.trajectory().poses, P, slam.filter


def _ideal(source):
    slam, poses, P = IdealEkfSlam(source.landmarks), [], []
    R = np.diag([source.sensor.range_sigma**2, source.sensor.bearing_sigma**2])
    for reading, true in zip(source, source.truth.poses, strict=True):
        pose = slam.x[:3].copy()
        Q = Q_arc(pose, reading.odometry, source.robot)
        slam.predict(compose(pose, reading.odometry), Q, true)
        seen = reading.observations
        slam.observe(seen.ids, seen.z, np.broadcast_to(R, (len(seen.ids), 2, 2)))
        poses.append(slam.x[:3].copy())
        P.append(slam.P[:3, :3].copy())
    return np.array(poses), P, slam


def _summary(source, poses, P, slam):
    errors = poses - source.truth.poses
    errors[:, 2] = wrap(errors[:, 2])
    off = slam.landmarks() - source.landmarks[slam.ids]
    return errors, np.array(P), float(np.mean(np.sum(off**2, axis=1)))


def row(runs):
    """Make a filter's row from its runs: NEES, steps outside the χ² band, largest eigenvalue, RMSE
    [m, degree]."""
    errors, P = (np.array([run[k] for run in runs])[:, BURN_IN:] for k in (0, 1))
    each = nees(errors, P)
    low, high = band(3, len(runs))
    over_runs = each.mean(axis=0)
    at_end = consistency(errors[:, -1], P[:, -1])
    return {
        "nees": each.mean(),
        # the steps of a run hang together, runs do not: their scatter gives the mean's error
        "nees_standard_error": each.mean(axis=1).std(ddof=1) / np.sqrt(len(runs)),
        "nees_median_run": np.median(each.mean(axis=1)),
        "nees_last": each[:, -LAST_STEPS:].mean(),
        "steps_above_band": np.mean(over_runs > high),
        "steps_below_band": np.mean(over_runs < low),
        "largest_eigenvalue_at_end": at_end.largest,
        "largest_eigenvalue_limit": at_end.limit,
        "position_rmse_m": np.sqrt(np.mean(np.sum(errors[..., :2] ** 2, axis=-1))),
        "heading_rmse_deg": np.degrees(np.sqrt(np.mean(errors[..., 2] ** 2))),
        "landmark_rmse_m": np.sqrt(np.mean([run[2] for run in runs])),
    }


def study(loop, runs, jobs=None, scheduler=None):
    """Make the table of seeds 0 to runs − 1; raise ValueError if there are too few runs."""
    if loop.steps < BURN_IN:
        raise ValueError(f"--steps must be at least {BURN_IN}, not {loop.steps}")
    results = map_runs(partial(errors_of, loop=loop), seeds(runs), jobs, scheduler)
    return {
        "versions": package_versions(),
        "seeds": [0, runs - 1],
        "first_runs": first_runs(results),
        "scenario": asdict(loop),
        "band_95": band(3, runs),
        "filters": rounded({name: row([result[name] for result in results]) for name in FILTERS}),
    }


def main(argv=None):
    argv = sys.argv[1:] if argv is None else argv
    command = parser("consistency", runs=100)
    for field in fields(Loop):
        kind = type(field.default)
        command.add_argument("--" + field.name.replace("_", "-"), type=kind, default=field.default)
    asked = command.parse_args(argv)

    def make():
        loop = Loop(**{field.name: getattr(asked, field.name) for field in fields(Loop)})
        return study(loop, asked.runs, asked.jobs, asked.scheduler)

    return write(command.prog, argv, asked.out, make)


if __name__ == "__main__":
    sys.exit(main())
