"""SLAM accuracy on real logs and simulated tours: error, CPU time, memory; GTSAM's optimum.

The relations are those 108 of 2984 whose stamps this shorter Intel log has; published figures are
of all of them and of the whole log.
"""

import sys
import time
from itertools import islice

import numpy as np

from benchmarks.common import Missing, cpu_times, main, row, speed_rows
from slamlab import estimators, sources
from slamlab.evaluation import load_relations, relations_error
from slamlab.geometry import between, compose
from slamlab.posegraph import PoseGraph
from slamlab.readings import Trajectory
from slamlab.sources import SourceError

TITLE = "SLAM: errors, CPU time of a reading, memory, and the optimum of the pose graph"
ESTIMATORS = ("odometry", "icp", "graph")
PUBLISHED = 0.031  # graph mapping on all relations of the Intel log, Kümmerle et al. 2009 [m]
TOURS = ("room", "corridor", "twins", "situation-1", "situation-2")
QUICK = 250  # readings of a log
FALSE_LOOP = 0.15, 0.1  # a loop closure farther off the truth is a false positive [m, rad]


def run(quick):
    """Rows of the Intel log, of another, of simulated tours and of the optimiser."""
    rows = []
    for name in ("intel", "exp1"):
        try:
            found, slam = log_rows(name, quick)
        except SourceError as error:
            print(f"left out: {error}", file=sys.stderr)
            continue
        rows += found
        if name == "intel":
            rows += optimum_rows(slam.graph, quick)
    for tour in TOURS[:2] if quick else TOURS:
        rows += tour_rows(tour, 1 if quick else 5)
    return rows


def run_estimator(estimator, readings):
    """Run an estimator over readings; its final trajectory and (n,) CPU seconds of each reading."""
    spent, times = [], []
    for reading in readings:
        begin = time.process_time()
        estimator.step(reading)
        spent.append(time.process_time() - begin)
        times.append(reading.time)
    return Trajectory(np.array(times), estimator.trajectory().poses), np.array(spent)


def log_rows(name, quick):
    """Relations errors where there are relations; time of readings and memory of the graph."""
    rows, rng = [], np.random.default_rng(0)
    log = sources.open(name, rng)
    readings = list(islice(log, QUICK if quick else None))
    relations = load_relations("intel-relations") if name == "intel" else None
    for kind in ESTIMATORS if relations else ("graph",):
        before, slam = peak_memory(), estimators.make(kind, log)
        trajectory, spent = run_estimator(slam, readings)
        if relations:
            error = relations_error(trajectory, relations)
            label = f"{name}: {kind}, {error.count} relations"
            near = PUBLISHED / error.translation
            rows.append(row(label, error.translation, "m", "published, all relations", near))
            rows.append(row(label, np.degrees(error.rotation), "deg", "", 1))
    period = float(np.median(np.diff(trajectory.times)))
    rows += [
        row(
            f"{name}: graph, {what} of a reading",
            1e3 * t,
            "ms",
            "time between readings",
            period / t,
        )
        for what, t in (
            ("mean", spent.mean()),
            ("median", np.median(spent)),
            ("99 %", np.quantile(spent, 0.99)),
            ("longest", spent.max()),
        )
    ]
    whole = trajectory.times.max() - trajectory.times.min()
    rows.append(
        row(f"{name}: graph, all", spent.sum(), "s", "time it took to drive", whole / spent.sum())
    )
    if relations and before is not None:  # the peak of the first log hides those after it
        grown = peak_memory() - before
        each = grown / len(readings) * 1e3
        rows.append(row(f"{name}: graph, memory, {each:.0f} kB a reading", grown, "MB", "", 1))
    print(f"{name}: {slam.status}", file=sys.stderr)
    return rows, slam


def peak_memory():
    """Peak memory of this process [MB], or None where the system does not say."""
    try:
        import resource
    except ImportError:
        return None
    scale = 2**20 if sys.platform == "darwin" else 2**10
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / scale


def tour_rows(name, seeds):
    """Largest error and error at the end of a tour, and false loop closures."""
    largest, ends, false = [], [], 0
    for seed in range(seeds):
        source = sources.open(f"sim:{name}", np.random.default_rng(seed))
        slam, true = estimators.make("graph", source), source.truth.poses
        poses = run_estimator(slam, source)[0].poses
        error = between(between(true[0], true), between(poses[0], poses))
        distance = np.hypot(error[:, 0], error[:, 1])
        largest.append(distance.max())
        ends.append(distance[-1])
        keys = true[np.flatnonzero(np.diff(slam.anchors, prepend=-1) > 0)]
        for edge in slam.graph.edges:
            off = between(between(keys[edge.i], keys[edge.j]), edge.measured)
            outlier = np.hypot(*off[:2]) > FALSE_LOOP[0] or abs(off[2]) > FALSE_LOOP[1]
            false += edge.robust and outlier
    label = f"{name}, {seeds} seeds"
    return [
        row(f"{label}: largest error", 1e3 * np.max(largest), "mm", "", 1),
        row(f"{label}: start to end", 1e3 * np.max(ends), "mm", "20 mm", 0.02 / np.max(ends)),
        row(f"{label}: false loops", false, "", "", 1),
    ]


def optimum_rows(graph, quick):
    """Pose-graph optimum, ours and GTSAM's of the same edges, all trusted, from odometry alone."""
    start = [np.zeros(3)]
    for edge in graph.edges:
        if edge.j == len(start) and edge.i == edge.j - 1:
            start.append(compose(start[-1], edge.measured))
    trusted = PoseGraph()
    for pose in start:
        trusted.add_pose(pose)
    for edge in graph.edges:
        trusted.add_edge(*edge[:4])

    def ours():
        trusted.poses = start
        return trusted.optimise().chi2

    try:
        theirs = gtsam(trusted, start)
    except Missing as error:
        print(f"left out: {error}", file=sys.stderr)
        return []
    costs = {"GTSAM": theirs(), "slamlab": ours()}
    label = f"optimum of {len(start)} poses, {len(graph.edges)} edges"
    rows = [
        row(f"{label}: χ², {name}", cost, "", "GTSAM", costs["GTSAM"] / cost)
        for name, cost in costs.items()
    ]
    return rows + speed_rows(label, cpu_times({"GTSAM": theirs, "slamlab": ours}, quick))


def gtsam(graph, start):
    """GTSAM's Levenberg-Marquardt on a graph's edges; a function that gives χ² at its optimum."""
    try:
        import gtsam as package
    except ImportError:
        raise Missing("GTSAM is not here: python -m pip install gtsam") from None
    factors, guesses = package.NonlinearFactorGraph(), package.Values()
    for edge in graph.edges:
        noise = package.noiseModel.Gaussian.Information(edge.information)
        motion = package.Pose2(*edge.measured)
        factors.add(package.BetweenFactorPose2(edge.i, edge.j, motion, noise))
    tight = package.noiseModel.Isotropic.Sigma(3, 1e-6)
    factors.add(package.PriorFactorPose2(0, package.Pose2(*start[0]), tight))
    for i, pose in enumerate(start):
        guesses.insert(i, package.Pose2(*pose))
    settings = package.LevenbergMarquardtParams()
    settings.setMaxIterations(100)

    def optimise():
        solver = package.LevenbergMarquardtOptimizer(factors, guesses, settings)
        return 2 * factors.error(solver.optimize())

    return optimise


if __name__ == "__main__":
    sys.exit(main({TITLE: run}, "python -m benchmarks.accuracy"))
