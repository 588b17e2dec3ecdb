"""Handheld lidar in flats, without odometry: end error, ATE and CPU time.

The data are ten walks of 45 to 55 m with the noise and scan rates of three lidars. Peers on the
same scans: kiss-icp, and small_gicp with a local map, constant velocity and deskewing. Goals for
the end error: 0.5 % of the path length for ``graph`` and 1 % for ``icp``, in nine of ten walks.
"""

import sys
import time

import numpy as np

from benchmarks.common import main, row
from benchmarks.odometry_peers import peers
from slamlab.estimators import make
from slamlab.evaluation import absolute_error
from slamlab.readings import Trajectory
from slamlab.simulation.range_scanners import RPLIDARS
from slamlab.sources.handheld_lidar import HandheldLidar

TITLE = "Handheld lidar: end error as share of the path length, ATE, CPU time per scan"
GOALS = {"graph": 0.5, "icp": 1.0}  # end error [% of the way]
# flat, lidar, usual speed [m/s], seed
WALKS = (
    *[("flat", "A1", 0.7, 1), ("flat-2", "A2", 0.85, 2), ("flat-3", "C1", 1.0, 3)],
    *[("flat", "A2", 1.0, 4), ("flat-2", "C1", 0.7, 5), ("flat-3", "A1", 0.85, 6)],
    *[("flat", "C1", 0.85, 7), ("flat-2", "A1", 1.0, 8), ("flat-3", "A2", 0.7, 9)],
    ("flat", "A2", 0.6, 10),
)


def run(quick):
    """Make rows for each walk, then for all walks; if quick, for three walks."""
    methods = {name: _estimated(name) for name in GOALS} | peers()
    results = {name: [] for name in methods}  # of each walk: end error [%], ATE [m], CPU time [s]
    rows = []
    for flat, lidar, speed, seed in WALKS[:3] if quick else WALKS:
        rng = np.random.default_rng(seed)
        source = HandheldLidar(flat, rng, lidar=RPLIDARS[lidar], speed=speed)
        readings = list(source)
        for name, method in methods.items():
            begin = time.process_time()
            poses = method(readings, source)
            spent = (time.process_time() - begin) / len(readings)
            results[name].append((*_errors(poses, source), spent))
            end, goal = results[name][-1][0], GOALS.get(name, GOALS["icp"])
            walk = f"{flat}, {lidar}, {speed} m/s"
            rows.append(row(f"{walk}: {name}", end, "% end", f"{goal} %", goal / end))
    return rows + _summary(results)


def _estimated(name):
    def method(readings, source):
        estimator = make(name, source)
        for reading in readings:
            estimator.step(reading)
        return estimator.trajectory().poses

    return method


def _errors(poses, source):
    """Return the end error [% of the path length] and the ATE [m] of poses that start at the
    origin."""
    truth = source.truth
    end = np.hypot(*(poses[-1] - truth.poses[-1])[:2])
    error = absolute_error(Trajectory(truth.times, poses), truth)
    return 100 * end / source.walk.length, error.translation


def _summary(results):
    rows, (_, ate_of_icp, cpu_of_icp) = [], np.median(results["icp"], axis=0)
    for name, found in results.items():
        goal, ends = GOALS.get(name, GOALS["icp"]), np.sort([end for end, _, _ in found])
        _, ate, cpu = np.median(found, axis=0)
        for which, end in (
            ("median", np.median(ends)),
            ("nine of ten", ends[-1 - len(ends) // 10]),
            ("largest", ends[-1]),
        ):
            rows.append(row(f"{which}: {name}", end, "% end", f"{goal} %", goal / end))
        rows += [
            row(f"median: {name}", ate, "m ATE", "icp", ate_of_icp / ate),
            row(f"median: {name}", 1e3 * cpu, "ms a scan", "icp", cpu_of_icp / cpu),
        ]
    return rows


if __name__ == "__main__":
    sys.exit(main({TITLE: run}, "python -m benchmarks.handheld_lidar"))
