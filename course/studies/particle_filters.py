"""``python -m course.studies.particle_filters``: Monte Carlo runs of particle filters.

The runs show global localisation with several numbers of particles, relocalisation of a kidnapped
robot with several numbers of injected random particles, and particle-filter SLAM compared with
odometry and EKF-SLAM on the same laps.
"""

import sys

import numpy as np

from course.studies import independent_particle_sets, study_command
from course.studies.global_localisation import film, near
from course.studies.paired_statistics import (
    mean_interval,
    median_interval,
    paired_difference,
    share_interval,
)
from course.studies.study_command import TABLES, first_runs, package_versions, seeds
from slamlab.parallel import map_runs

TABLE = TABLES / "particle_filters.json"
COUNTS = (50, 100, 200, 500, 1000, 2000, 5000)
INJECTED = (0, 5, 25, 50, 100, 250)  # random particles of 500, in every step
CARRIED, STEPS, BEFORE = 25, 60, slice(16, 26)  # BEFORE: steps before the robot is kidnapped
SEES_POST = 9.0  # range that reaches the post from anywhere in the room [m]


def one_run(seed):
    """Return for one seed "found" {n: bool}, "injected" {number: (followed, relocalised,
    error before [m])}, "maps" {name: (rms [m], share outside)}."""
    laps = {}
    for name, make in independent_particle_sets.MAKERS.items():
        run = independent_particle_sets.lap(seed)
        laps[name] = independent_particle_sets.judged(run, make(run))
    return {
        "found": {n: near(*film(n, seed)[-1]) > 0.5 for n in COUNTS},
        "injected": {k: _kidnapped(seed, k) for k in INJECTED},
        "maps": laps,
    }


def _kidnapped(seed, injected):
    """Return whether the particles followed the robot until it was kidnapped, whether it was
    relocalised, and the estimate's mean position error before the kidnapping [m]."""
    pictures = film(500, seed, STEPS, SEES_POST, injected, CARRIED)
    off = [np.hypot(*(cloud.moments.x - truth)[:2]) for cloud, truth in pictures[BEFORE]]
    return near(*pictures[CARRIED]) > 0.5, near(*pictures[-1]) > 0.5, float(np.mean(off))


def study(runs, jobs=None, scheduler=None):
    """Make the tables "found", "injected" (random particles), "maps": shares, medians [m], and mean
    shares "outside" with 95 % intervals; raise ValueError for fewer than 6 runs."""
    results = map_runs(one_run, seeds(runs, 6), jobs, scheduler)
    laps = {
        name: np.array([each["maps"][name] for each in results]).T
        for name in independent_particle_sets.MAKERS
    }
    return {
        "versions": package_versions(),
        "runs": runs,
        "first_runs": first_runs(results),
        "found": {n: share_interval(sum(r["found"][n] for r in results), runs) for n in COUNTS},
        "injected": {k: _injection_row([r["injected"][k] for r in results]) for k in INJECTED},
        "maps": {name: _map_row(laps, name) for name in laps},
    }


def _injection_row(results):
    followed, found, off = zip(*results, strict=True)
    return {
        "followed": share_interval(sum(followed), len(followed)),
        "found": share_interval(sum(found), len(found)),
        "error before": median_interval(off),
    }


def _map_row(laps, name):
    (rms, outside), row = laps[name], {}
    row["rms"] = median_interval(rms)
    for other in (independent_particle_sets.WHEELS, independent_particle_sets.EKF):
        if name != other:
            row[f"against {other}"] = paired_difference(rms, laps[other][0])
    return row if np.isnan(outside).any() else row | {"outside": mean_interval(outside)}


def main(argv=None):
    return study_command.main("particle_filters", 60, study, argv)


if __name__ == "__main__":
    sys.exit(main())
