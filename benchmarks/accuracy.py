"""SLAM accuracy on real logs and simulated tours: error, CPU time, memory; GTSAM's optimum.

This Intel log is shorter than the published log: it contains the time stamps of 108 of the 2984
relations. Published results are for all relations and the whole log.
"""

import sys
import time
from itertools import islice

import numpy as np

from benchmarks.common import Missing, cpu_times, main, row, speed_rows
from slamlab import estimators, sources
from slamlab.evaluation import load_relations, relations_error
from slamlab.evaluation.relations import usable_relations
from slamlab.geometry import between, compose
from slamlab.posegraph import PoseGraph
from slamlab.readings import Trajectory
from slamlab.scanmatching import match
from slamlab.sources import SourceError

TITLE = "SLAM: errors, CPU time per reading, memory, and the optimum of the pose graph"
ESTIMATORS = ("odometry", "icp", "graph")
# Kümmerle et al. 2009, all relations of the Intel log: the method and its mean error [m]; their
# particle filter has 0.070
PUBLISHED = {"icp": ("scan matching", 0.220), "graph": ("graph mapping", 0.031)}
TOURS = ("room", "corridor", "twins", "situation-1", "situation-2")
QUICK = 250  # readings of a log
FALSE_LOOP = 0.15, 0.1  # error beyond which a loop closure is a false positive [m, rad]


def run(quick):
    """Make rows for the Intel log, another log, simulated tours and the optimiser."""
    rows = []
    for name in ("intel", "exp1"):
        try:
            found, slam = log_rows(name, quick)
        except SourceError as error:
            print(f"skipped: {error}", file=sys.stderr)
            continue
        rows += found
        if name == "intel":
            rows += optimum_rows(slam.graph, quick)
    for tour in TOURS[:2] if quick else TOURS:
        rows += tour_rows(tour, 1 if quick else 5)
    return rows


def run_estimator(estimator, readings):
    """Run an estimator on readings; return its final trajectory and the CPU time per reading (n,)
    [s]."""
    spent, times = [], []
    for reading in readings:
        begin = time.process_time()
        estimator.step(reading)
        spent.append(time.process_time() - begin)
        times.append(reading.time)
    return Trajectory(np.array(times), estimator.trajectory().poses), np.array(spent)


def log_rows(name, quick):
    """Make rows for a log: relative pose errors if it has relations, time per reading, memory."""
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
            method, published = PUBLISHED.get(kind, ("", error.translation))
            peer = method and f"published: {method}"
            rows.append(row(label, error.translation, "m", peer, published / error.translation))
            rows.append(row(label, np.degrees(error.rotation), "deg", "", 1))
    if relations:
        limit = direct_match_error(readings, trajectory.times, relations)
        rows.append(row(f"{name}: direct matches from the relations as guess", limit, "m", "", 1))
    period = float(np.median(np.diff(trajectory.times)))
    rows += [
        row(
            f"{name}: graph, {what} per reading",
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
        row(f"{name}: graph, all", spent.sum(), "s", "duration of the log", whole / spent.sum())
    )
    if relations and before is not None:  # the peak of the first log hides later ones
        grown = peak_memory() - before
        each = grown / len(readings) * 1e3
        rows.append(row(f"{name}: graph, memory, {each:.0f} kB per reading", grown, "MB", "", 1))
    print(f"{name}: {slam.status}", file=sys.stderr)
    return rows, slam


def direct_match_error(readings, times, relations):
    """Return the relations error [m] of matching the two scans of each relation directly, with the
    relation as initial guess: a trajectory that agrees with the scans has hardly less."""
    pairs, wanted = usable_relations(times, relations)
    scans = {k: readings[k].scan.points() for k in set(pairs.ravel().tolist())}
    ends = zip(pairs.tolist(), wanted, strict=True)
    found = [match(scans[j], scans[i], z).pose for (i, j), z in ends]
    return float(np.hypot(*between(wanted, np.array(found))[:, :2].T).mean())


def peak_memory():
    """Return the peak memory of this process [MB], or None if the system does not report it."""
    try:
        import resource
    except ImportError:
        return None
    scale = 2**20 if sys.platform == "darwin" else 2**10
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / scale


def tour_rows(name, seeds):
    """Make rows for a tour: largest error, final error, false loop closures."""
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
    """Compare our pose-graph optimum with that of GTSAM, with the same non-robust edges and
    odometry start."""
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
        print(f"skipped: {error}", file=sys.stderr)
        return []
    costs = {"GTSAM": theirs(), "slamlab": ours()}
    label = f"optimum of {len(start)} poses, {len(graph.edges)} edges"
    rows = [
        row(f"{label}: χ², {name}", cost, "", "GTSAM", costs["GTSAM"] / cost)
        for name, cost in costs.items()
    ]
    return rows + speed_rows(label, cpu_times({"GTSAM": theirs, "slamlab": ours}, quick))


def gtsam(graph, start):
    """Return a function that optimises a graph by GTSAM's Levenberg-Marquardt and returns its
    χ²."""
    try:
        import gtsam as package
    except ImportError:
        raise Missing("GTSAM is not installed: python -m pip install gtsam") from None
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
