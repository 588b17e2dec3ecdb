"""``python -m slamlab.studies.three``: BOR, MAK (EKF) and Monte Carlo compared on the same drives.

Box, ellipse and samples in the MAK thesis' comparison (ch. 8): its six data sets, one with a
snagged cable, and then as many drives as are asked for, each once as it was driven and once with a
snagged cable.
"""

import sys
from dataclasses import replace
from functools import partial

import numpy as np

from slamlab.estimators.bor_slam import BorSlam
from slamlab.estimators.by_name import make
from slamlab.estimators.landmark_observations import observed_landmarks
from slamlab.parallel import map_runs
from slamlab.sources.arena_runs import SETS, ArenaRun, data_set
from slamlab.studies import study_command
from slamlab.studies.study_command import TABLES, package_versions, seeds
from slamlab.studies.three_costs import scan_costs
from slamlab.studies.three_records import LOST, record, summary
from slamlab.studies.three_rows import rows

TABLE = TABLES / "three.json"
FIRST_SEED = 5000  # of the drives; no constant was chosen on one of these
FILTERS = {
    "odometry": partial(make, "odometry"),
    "BOR, honest": partial(make, "bor"),
    "BOR, tuned": partial(make, "bor", bounds="tuned"),
    "MAK": partial(make, "mak"),
    "Monte Carlo": partial(make, "montecarlo"),
    "Monte Carlo, never frozen": partial(make, "montecarlo", close=0),
    "FastSLAM": partial(make, "fastslam"),
    "walls": partial(make, "walls"),
}
"""Makers of a filter for a source. Corners get their names of one EKF-SLAM, for all alike."""
OWN_NAMES = {
    "BOR, honest": partial(make, "bor", names="own"),
    "BOR, tuned": partial(make, "bor", bounds="tuned", names="own"),
    "Monte Carlo": partial(make, "montecarlo", names="own"),
    "FastSLAM": partial(make, "fastslam", names="own"),
}
"""The same, but each filter does the data association itself."""
SIGMAS = (1.0, 2.0, 3.0, 4.5, 6.0)  # standard deviations that a bound of a box is taken to be


def bounded(sigmas, source):
    """Maker of a box filter all of whose bounds are so many standard deviations."""
    return BorSlam(source.robot, source.sensor, sigmas=sigmas, way_sigmas=sigmas, names="mak")


def with_corners(source):
    """Extract the corner landmarks of a source's scans once, for every filter alike.

    Parameters
    ----------
    source : ArenaRun

    Returns
    -------
    list of Reading, landmark observations beside the scans
    """
    rng = np.random.default_rng(0)
    return [
        replace(reading, observations=observed_landmarks(reading, source.sensor, rng))
        for reading in source
    ]


def records_of(source, readings, filters):
    """Records of filters on one drive.

    Parameters
    ----------
    source : ArenaRun
    readings : its own, :func:`with_corners`
    filters : {name: callable(source) -> Estimator}, such as FILTERS

    Returns
    -------
    {name: Record}
    """
    return {name: record(make(source), source, readings) for name, make in filters.items()}


def errors_of(source, readings):
    """Position errors of every filter on one drive.

    Parameters
    ----------
    source : ArenaRun
    readings : its own, :func:`with_corners`

    Returns
    -------
    {name: (n,) how far off the position is after each scan [m]}
    """
    return {name: each.errors for name, each in records_of(source, readings, FILTERS).items()}


def run(seed):
    """Records of every filter on one drive: {kind: {name: Record}}.

    The kinds are "free", "snagged", and on the free drive "own_names" and "bounds", boxes of all
    SIGMAS.
    """
    free = ArenaRun(np.random.default_rng(seed))
    held, readings = free.snagged(), with_corners(free)
    pulled = [replace(r, odometry=h.odometry) for r, h in zip(readings, held, strict=True)]
    beside, boxes = {"odometry": FILTERS["odometry"]}, {str(k): partial(bounded, k) for k in SIGMAS}
    found = records_of(free, readings, FILTERS)
    return {
        "free": found,
        "snagged": records_of(held, pulled, FILTERS),
        "own_names": records_of(free, readings, beside | OWN_NAMES),
        "bounds": {name: found[name] for name in ("odometry", "Monte Carlo")}
        | records_of(free, readings, boxes),
    }


def six_data_sets():
    """Results on the six data sets: a row each with every filter's final and RMS error."""
    lines = []
    for seed, snagged in SETS:
        source = data_set(seed, snagged)
        errors = errors_of(source, with_corners(source))
        found = {name: summary(each) for name, each in errors.items()}
        lines.append({"seed": seed, "snagged": snagged, "filters": found})
    return lines


def study(runs, jobs=None, scheduler=None):
    """The tables of the study: errors and costs of every filter.

    Parameters
    ----------
    runs : int; seeds from FIRST_SEED on
    jobs, scheduler : see :func:`slamlab.parallel.map_runs`

    Returns
    -------
    dict

    Raises
    ------
    ValueError : fewer runs than 3
    """
    drives = [FIRST_SEED + k for k in seeds(runs)]
    results = map_runs(run, drives, jobs, scheduler)
    return {
        "versions": package_versions(),
        "seeds": [drives[0], drives[-1]],
        "lost_beyond_m": LOST,
        "six": six_data_sets(),
        "many": {kind: rows([result[kind] for result in results]) for kind in results[0]},
        "cost": scan_costs(),
    }


def main(argv=None):
    """The command: run the study, write its table; exit code 0, or 2 on an error."""
    return study_command.main("three", 80, study, argv)


if __name__ == "__main__":
    sys.exit(main())
