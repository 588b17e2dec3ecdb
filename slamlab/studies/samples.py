"""``python -m slamlab.studies.samples``: how many samples find a robot, what strangers are worth,
and what maps by samples are worth beside odometry and EKF-SLAM on the same laps."""

import sys

import numpy as np

from slamlab.parallel import map_runs
from slamlab.studies import sets_apart, study_command
from slamlab.studies.paired_statistics import median_interval, paired_difference, share_interval
from slamlab.studies.sampled_room import film, near
from slamlab.studies.study_command import TABLES, package_versions, seeds

TABLE = TABLES / "samples.json"
COUNTS = (50, 100, 200, 500, 1000, 2000, 5000)
STRANGERS = (0, 5, 25, 50, 100, 250)  # of 500 samples, in every step
CARRIED, STEPS, BEFORE = 25, 60, slice(16, 26)  # pictures before the robot is carried off
SEES_POST = 9.0  # from anywhere in the room [m]


def one_run(seed):
    """All that is asked, for one seed.

    Parameters
    ----------
    seed : int

    Returns
    -------
    dict with "found" {n: bool}, "strangers" {k: (found again, error before)}, "maps" {name:
    (rms, outside)}
    """
    laps = {}
    for name, make in sets_apart.MAKERS.items():
        run = sets_apart.lap(seed)
        laps[name] = sets_apart.judged(run, make(run))
    return {
        "found": {n: near(*film(n, seed)[-1]) > 0.5 for n in COUNTS},
        "strangers": {k: _carried_off(seed, k) for k in STRANGERS},
        "maps": laps,
    }


def _carried_off(seed, strangers):
    """Whether the robot was found again, and how far the mean was off before [m]."""
    pictures = film(500, seed, STEPS, SEES_POST, strangers, CARRIED)
    off = [np.hypot(*(cloud.moments.x - truth)[:2]) for cloud, truth in pictures[BEFORE]]
    return near(*pictures[-1]) > 0.5, float(np.mean(off))


def study(runs, jobs=None, scheduler=None):
    """The tables: shares and medians over the runs, with 95 % intervals.

    Parameters
    ----------
    runs : int; seeds 0 to runs − 1
    jobs, scheduler : see :func:`slamlab.parallel.map_runs`

    Returns
    -------
    dict

    Raises
    ------
    ValueError : fewer runs than 6
    """
    results = map_runs(one_run, seeds(runs, 6), jobs, scheduler)
    laps = {
        name: np.array([each["maps"][name] for each in results]).T for name in sets_apart.MAKERS
    }
    return {
        "versions": package_versions(),
        "runs": runs,
        "found": {n: share_interval(sum(r["found"][n] for r in results), runs) for n in COUNTS},
        "strangers": {k: _stranger_row([r["strangers"][k] for r in results]) for k in STRANGERS},
        "maps": {name: _map_row(laps, name) for name in laps},
    }


def _stranger_row(pairs):
    found, off = zip(*pairs, strict=True)
    return {"found": share_interval(sum(found), len(found)), "error before": median_interval(off)}


def _map_row(laps, name):
    (rms, outside), row = laps[name], {}
    row["rms"] = median_interval(rms)
    for other in (sets_apart.WHEELS, sets_apart.EKF):
        if name != other:
            row[f"against {other}"] = paired_difference(rms, laps[other][0])
    return row if np.isnan(outside).any() else row | {"outside": median_interval(outside)}


def main(argv=None):
    """Run the study and write its table.

    Parameters
    ----------
    argv : list of str, the command's arguments; those of this process by default

    Returns
    -------
    int, what the command ends with
    """
    return study_command.main("samples", 60, study, argv)


if __name__ == "__main__":
    sys.exit(main())
