"""``python -m slamlab.studies.three``: BOR, MAK (EKF) and Monte Carlo compared on the same drives.

Box, ellipse and samples in the MAK thesis' comparison (ch. 8): its six data sets, one with a
snagged cable, and then as many drives as are asked for, each once as it was driven and once with a
snagged cable.
"""

import sys
from dataclasses import replace

import numpy as np
from scipy.stats import binomtest, bootstrap

from slamlab import estimators
from slamlab.estimators.bor_slam import BorSlam
from slamlab.estimators.landmark_observations import observed_landmarks
from slamlab.parallel import map_runs
from slamlab.sources.arena_runs import LAPS, SETS, ArenaRun, data_set
from slamlab.studies import study_command
from slamlab.studies.study_command import TABLES, package_versions, seeds
from slamlab.studies.three_costs import scan_costs

TABLE = TABLES / "three.json"
LOST = 0.12  # a filter farther off is lost: by the robot's width it would hit the wall [m]
TUNED = 0.1, 1.5  # bounds of odometry and of corners, in standard deviations [1]


def tuned_bor(source):
    """BOR with bounds chosen by results, on drives that are in no table: no guarantee is left.

    Errors of many steps add up like a root, bounds as they are: what holds for every step is far
    too wide for many.
    """
    odometry, corner = TUNED
    narrow = replace(source.robot, slip=source.robot.slip * odometry / corner)
    return BorSlam(narrow, source.sensor, sigmas=corner)


FILTERS = {
    "odometry": lambda source: estimators.make("odometry", source),
    "BOR, 3σ": lambda source: estimators.make("bor", source),
    "BOR, tuned": tuned_bor,
    "MAK": lambda source: estimators.make("mak", source),
    "Monte Carlo": lambda source: estimators.make("montecarlo", source),
    "FastSLAM": lambda source: estimators.make("fastslam", source),
}


def with_corners(source):
    """Extract the corner landmarks of a source's scans once, for every filter alike.

    Parameters
    ----------
    source : ArenaRun

    Returns
    -------
    list of Reading, landmark observations in the place of scans
    """
    rng = np.random.default_rng(0)
    return [
        replace(reading, scan=None, observations=observed_landmarks(reading, source.sensor, rng))
        for reading in source
    ]


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
    found = {}
    for name, make in FILTERS.items():
        slam = make(source)
        for reading in readings:
            slam.step(reading)
        found[name] = np.hypot(*(slam.trajectory().poses - source.truth.poses)[:, :2].T)
    return found


def summary(errors):
    """Summary of one run of one filter: RMS error, strayed, lost.

    Lost is who is off by more than ``LOST`` at the end; it was lost from where it last went so far
    off. Strayed is who ever was.

    Parameters
    ----------
    errors : (n,) of position [m]

    Returns
    -------
    dict: laps_m at the end of each, rms_m, before_m the root mean square before it strayed [m],
    strayed, lost, and lost_at, the share of the way driven until it was lost, or None
    """
    far = errors > LOST
    before = errors[: int(np.argmax(far))] if far.any() else errors
    last_good = np.flatnonzero(~far)[-1]  # there is one: every run begins at the truth
    return {
        "laps_m": [float(errors[len(errors) * lap // LAPS - 1]) for lap in range(1, LAPS + 1)],
        "rms_m": float(np.sqrt(np.mean(errors**2))),
        "before_m": float(np.sqrt(np.mean(before**2))),
        "strayed": bool(far.any()),
        "lost": bool(far[-1]),
        "lost_at": float(last_good + 1) / len(errors) if far[-1] else None,
    }


def nearer(first, second):
    """Whether one filter has the smaller error until either strays.

    Parameters
    ----------
    first, second : (n,) errors on the same drive [m]

    Returns
    -------
    bool
    """
    far = np.maximum(first, second) > LOST
    way = slice(int(np.argmax(far)) if far.any() else len(far))
    return bool(np.sum(first[way] ** 2) < np.sum(second[way] ** 2))


def run(seed):
    """Errors of every filter on one drive, free and snagged: {(name, snagged): (n,) errors [m]}."""
    free = ArenaRun(np.random.default_rng(seed))
    held, readings = free.snagged(), with_corners(free)
    pulled = [replace(r, odometry=h.odometry) for r, h in zip(readings, held, strict=True)]
    return {
        (name, source is held): errors
        for source, given in ((free, readings), (held, pulled))
        for name, errors in errors_of(source, given).items()
    }


def row(runs, others):
    """One row of the table: medians and shares, each with its 95 % interval.

    Parameters
    ----------
    runs : list of (n,) errors [m]
    others : list of (n,) errors of Monte Carlo on the same drives [m]

    Returns
    -------
    dict of (value, low, high) [m] or shares, and the counts behind the shares
    """
    found = [summary(errors) for errors in runs]
    strayed, lost = (sum(each[key] for each in found) for key in ("strayed", "lost"))
    line = {key: _median([each[key] for each in found]) for key in ("rms_m", "before_m")}
    line["laps_m"] = [_median(lap) for lap in zip(*(each["laps_m"] for each in found), strict=True)]
    wins = sum(nearer(mine, other) for mine, other in zip(runs, others, strict=True))
    line["nearer_than_monte_carlo"] = _share(wins, len(runs))
    line["strayed"], line["lost"] = _share(strayed, len(runs)), _share(lost, len(runs))
    line["lost_of_strayed"] = _share(lost, strayed) if strayed else None
    return line | {"runs": len(runs), "runs_strayed": strayed, "runs_lost": lost}


def _rows(results):
    """{name: row} of many runs of all filters."""
    others = [result["Monte Carlo"] for result in results]
    return {name: row([result[name] for result in results], others) for name in FILTERS}


def _median(values):
    """(3,) median and its confidence interval by bootstrap."""
    if min(values) == max(values):  # which has no bootstrap
        return [values[0]] * 3
    rng = np.random.default_rng(0)
    interval = bootstrap((values,), np.median, method="percentile", rng=rng).confidence_interval
    return [round(float(v), 4) for v in (np.median(values), *interval)]


def _share(count, total):
    """(3,) a share and its Wilson confidence interval."""
    interval = binomtest(count, total).proportion_ci(method="wilson")
    return [round(float(v), 4) for v in (count / total, *interval)]


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
    runs : int; seeds 0 to runs − 1
    jobs, scheduler : see :func:`slamlab.parallel.map_runs`

    Returns
    -------
    dict

    Raises
    ------
    ValueError : fewer runs than 3
    """
    results = map_runs(run, seeds(runs), jobs, scheduler)
    return {
        "versions": package_versions(),
        "seeds": [0, runs - 1],
        "lost_beyond_m": LOST,
        "six": six_data_sets(),
        "many": {
            kind: _rows([{name: result[name, snagged] for name in FILTERS} for result in results])
            for kind, snagged in (("free", False), ("snagged", True))
        },
        "cost": scan_costs(),
    }


def main(argv=None):
    """The command: run the study, write its table; exit code 0, or 2 on an error."""
    return study_command.main("three", 200, study, argv)


if __name__ == "__main__":
    sys.exit(main())
