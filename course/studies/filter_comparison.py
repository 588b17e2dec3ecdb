"""``python -m course.studies.filter_comparison``: compare the filters BOR (set membership), MAK
(EKF) and Monte Carlo on the same runs.

The runs are the six data sets of the MAK thesis (ch. 8) and ``--runs`` further runs; each run is
repeated with a snagged cable.
"""

import sys
from dataclasses import replace
from functools import partial

import numpy as np

from course.studies import study_command
from course.studies.filter_comparison_table import rows
from course.studies.filter_costs import scan_costs
from course.studies.filter_records import LOST, record, summary
from course.studies.study_command import TABLES, first_runs, package_versions, seeds
from slamlab.estimators.factory import make
from slamlab.estimators.landmark_observations import observed_landmarks
from slamlab.estimators.set_membership_slam import SetMembershipSlam
from slamlab.parallel import map_runs
from slamlab.sources.arena_runs import SETS, ArenaRun, data_set

TABLE = TABLES / "filter_comparison.json"
FIRST_SEED = 5000  # of the runs; no constant was chosen on one of these
FILTERS = {
    "odometry": partial(make, "odometry"),
    "BOR, 4.5 σ": partial(make, "bor"),
    "BOR, tuned": partial(make, "bor", bounds="tuned"),
    "MAK": partial(make, "mak"),
    "Monte Carlo": partial(make, "montecarlo"),
    "Monte Carlo, never frozen": partial(make, "montecarlo", freeze_distance=0),
    "FastSLAM": partial(make, "fastslam"),
    "walls": partial(make, "walls"),
}
"""Functions that create a filter for a source. All filters use the data association of one
EKF-SLAM."""
OWN_ASSOCIATION = {
    "BOR, 4.5 σ": partial(make, "bor", association="own"),
    "BOR, tuned": partial(make, "bor", bounds="tuned", association="own"),
    "Monte Carlo": partial(make, "montecarlo", association="own"),
    "FastSLAM": partial(make, "fastslam", association="own"),
}
"""Functions that create a filter with its own data association."""
SIGMAS = (1.0, 2.0, 3.0, 4.5, 6.0)  # bounds of a box in standard deviations


def bounded(sigmas, source):
    """Make a set-membership filter whose bounds are all ``sigmas`` standard deviations."""
    return SetMembershipSlam(
        source.robot, source.sensor, sigmas=sigmas, accumulated_sigmas=sigmas, association="ekf"
    )


def with_corners(source):
    """Return an ArenaRun's readings with corners, extracted once for all filters."""
    rng = np.random.default_rng(0)
    return [
        replace(reading, observations=observed_landmarks(reading, source.sensor, rng))
        for reading in source
    ]


def records_of(source, readings, filters):
    """Return the Records of filters, {name: callable(source)}, on one run, by name."""
    return {name: record(make(source), source, readings) for name, make in filters.items()}


def errors_of(source, readings):
    """Return the position errors (n,) [m] of every filter on one run, by name."""
    return {name: each.errors for name, each in records_of(source, readings, FILTERS).items()}


def run(seed):
    """Return the Records of one run, {kind: {name: Record}}: "free", "snagged", and for the free
    run "own_association" and "bounds" (boxes with all SIGMAS)."""
    free = ArenaRun(np.random.default_rng(seed))
    held, readings = free.snagged(), with_corners(free)
    pulled = [replace(r, odometry=h.odometry) for r, h in zip(readings, held, strict=True)]
    beside, boxes = {"odometry": FILTERS["odometry"]}, {str(k): partial(bounded, k) for k in SIGMAS}
    found = records_of(free, readings, FILTERS)
    return {
        "free": found,
        "snagged": records_of(held, pulled, FILTERS),
        "own_association": records_of(free, readings, beside | OWN_ASSOCIATION),
        "bounds": {name: found[name] for name in ("odometry", "Monte Carlo")}
        | records_of(free, readings, boxes),
    }


def six_data_sets():
    """Return one row per data set with the errors of all filters."""
    lines = []
    for seed, snagged in SETS:
        source = data_set(seed, snagged)
        errors = errors_of(source, with_corners(source))
        found = {name: summary(each) for name, each in errors.items()}
        lines.append({"seed": seed, "snagged": snagged, "filters": found})
    return lines


def study(runs, jobs=None, scheduler=None):
    """Make the tables "six", "many" and "cost"; raise ValueError for fewer than 3 runs."""
    run_seeds = [FIRST_SEED + k for k in seeds(runs)]
    results = map_runs(run, run_seeds, jobs, scheduler)
    return {
        "versions": package_versions(),
        "seeds": [run_seeds[0], run_seeds[-1]],
        "first_runs": first_runs(results),
        "lost_beyond_m": LOST,
        "six": six_data_sets(),
        "many": {kind: rows([result[kind] for result in results]) for kind in results[0]},
        "cost": scan_costs(),
    }


def main(argv=None):
    return study_command.main("filter_comparison", 80, study, argv)


if __name__ == "__main__":
    sys.exit(main())
