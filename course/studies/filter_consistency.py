"""``python -m course.studies.filter_consistency``: consistency of the filters on the runs of
``filter_comparison``.

For each run, the share of scans with the true pose outside the filter's 95 % confidence region.
"""

import sys

import numpy as np

from course.studies import study_command
from course.studies.arena_corners import associated_by_ekf
from course.studies.filter_comparison import FILTERS, FIRST_SEED, with_corners
from course.studies.paired_statistics import median_interval
from course.studies.study_command import TABLES, first_runs, package_versions, seeds
from slamlab.evaluation.consistency import nees
from slamlab.geometry import wrap
from slamlab.parallel import map_runs
from slamlab.sources.arena_runs import ArenaRun

TABLE = TABLES / "filter_consistency.json"
GAUSSIAN = ("MAK", "Monte Carlo", "Monte Carlo, never frozen", "FastSLAM", "walls")
CHI2_95 = 7.815  # 95 % of χ² with three degrees of freedom
LEAST = 1e-6  # standard deviation that is added, for particles that are all equal [m, rad]


def pose_belief(slam):
    """Return the mean (3,) and the covariance (3, 3) of the pose of an EKF-SLAM or a particle
    filter."""
    if hasattr(slam.filter, "robot"):
        return slam.filter.robot.moments.x, slam.filter.robot.moments.P
    return slam.filter.x[:3], slam.filter.P[:3, :3]


def pose_nees_of_run(slam, readings, truth):
    """Run a new Estimator and return the NEES of its pose (n − 1,), without the certain start."""
    errors, covariances = [], []
    for reading, pose in zip(readings, truth, strict=True):
        slam.step(reading)
        x, P = pose_belief(slam)
        errors.append([*(x - pose)[:2], wrap(x[2] - pose[2])])
        covariances.append(P + LEAST**2 * np.eye(3))
    return nees(np.array(errors), np.array(covariances))[1:]


def run(seed):
    """Return the share of scans with the true pose outside the 95 % region, by filter."""
    source = ArenaRun(np.random.default_rng(seed))
    readings = associated_by_ekf(source, with_corners(source))
    found = {}
    for name in GAUSSIAN:
        values = pose_nees_of_run(FILTERS[name](source), readings, source.truth.poses)
        found[name] = float(np.mean(values > CHI2_95))
    return found


def study(runs, jobs=None, scheduler=None):
    """Make the table; raise ValueError for fewer than 3 runs."""
    run_seeds = [FIRST_SEED + k for k in seeds(runs)]
    results = map_runs(run, run_seeds, jobs, scheduler)
    shares = {name: np.array([result[name] for result in results]) for name in GAUSSIAN}
    return {
        "versions": package_versions(),
        "seeds": [run_seeds[0], run_seeds[-1]],
        "first_runs": first_runs(results),
        "filters": {
            name: {
                "outside_mean": round(float(each.mean()), 4),
                "outside_median": median_interval(each),
                "runs_above_5_percent": int(np.sum(each > 0.05)),
            }
            for name, each in shares.items()
        },
    }


def main(argv=None):
    return study_command.main("filter_consistency", 80, study, argv)


if __name__ == "__main__":
    sys.exit(main())
