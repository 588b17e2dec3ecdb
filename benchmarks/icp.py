"""Scan matching (ICP), compared with the thesis' ICP, and with small_gicp and Open3D if installed.

The parts of a match give a lower bound on its time. With unprocessed point clouds, about half of
the time is spent on fitting lines to both clouds; SLAM fits them once per scan. About six searches
for all correspondences by bearing cost as much as building and querying a k-d tree once. The
thesis' ICP builds and queries a k-d tree in each of its dozens of iterations.
"""

import sys
from dataclasses import replace
from functools import partial

import numpy as np
from scipy.spatial import cKDTree

from benchmarks import icp_peers
from benchmarks.common import cpu_times, main, row, speed_rows
from slamlab.geometry import between, transform
from slamlab.scanmatching import match, point_to_line, point_to_point, preprocess, rigid_fit
from slamlab.scanmatching.correspondences import find_correspondences
from slamlab.simulation.range_scanners import RPLIDAR_A2
from slamlab.sources.simulated_robot import POLYGON_WRONG_STEPS, simulation, turn_then_drive

TITLE = "Scan matching on the polygon, wrong odometry as the guess (CPU time, methods taking turns)"
TOLERANCE = 1e-6  # convergence, the thesis' 0.001 mm [m]
NOISE, HARD = 0.0075, 0.01  # σ as a share of the range: the lidar's data sheet, and Smolec's
TIGHT, FOUND = (0.015, np.radians(0.5)), (0.05, np.radians(2))  # success within [m, rad]
BASINS = {  # of convergence: turns [°] and ways [m] of the guess from the truth
    "0–45°, 0–0.6 m": ((0, 15, 30, 45), (0.0, 0.2, 0.4, 0.6)),
    "60–90°, 0–1 m": ((60, 75, 90), (0.0, 0.33, 0.67, 1.0)),
}


def thesis_icp(neighbours, source, target, guess):
    """Run ICP as in the thesis' listing: build and query scikit-learn's search tree in each
    iteration."""
    moved, last = transform(guess, source), 0.0
    for _ in range(500):
        search = neighbours(n_neighbors=1).fit(target)
        distances, indices = search.kneighbors(moved)
        moved = transform(rigid_fit(moved, target[indices.ravel()]), moved)
        if abs(last - distances.mean()) < TOLERANCE:
            break
        last = distances.mean()
    return rigid_fit(source, moved)


def scan_pairs(count, noise=NOISE):
    """Make pairs of scans with the initial guess and the true motion: (source, target, guess,
    true)."""
    guesses, found = turn_then_drive(POLYGON_WRONG_STEPS), []
    lidar = replace(RPLIDAR_A2, range_error=noise)
    for seed in range(count):
        run = simulation("polygon-wrong", np.random.default_rng(seed), lidar)
        clouds = [reading.scan.points() for reading in run]
        poses = run.truth.poses
        for i, guess in enumerate(guesses):
            true = between(poses[i], poses[i + 1])
            found.append((clouds[i + 1], clouds[i], guess, true))
    return found


def errors(method, cases):
    """Return the position and heading errors (n, 2) of a method's poses [m, rad]."""
    e = np.array([between(true, method(*clouds, guess)) for *clouds, guess, true in cases])
    return np.column_stack([np.hypot(e[:, 0], e[:, 1]), np.abs(e[:, 2])])


def share(found, limits):
    """Return the share of errors within limits [1]."""
    return float((found < limits).all(axis=1).mean())


def run(quick):
    """Make rows for time, error, success rate and basin of convergence."""
    methods = {
        "thesis' ICP": partial(thesis_icp, icp_peers.sklearn_neighbours()),
        "point to point": lambda *case: point_to_point(*case, tolerance=TOLERANCE).pose,
        "point to line": lambda *case: point_to_line(*case).pose,
        "match": lambda *case: match(*case).pose,
        **icp_peers.peers(),
    }
    cases = scan_pairs(4 if quick else 30)
    found = {name: errors(method, cases) for name, method in methods.items()}
    np.testing.assert_allclose(found["point to point"], found["thesis' ICP"], atol=1e-3)
    return [
        *time_rows(methods, cases[:6], quick),
        *part_rows(cases[:6], quick),
        *error_rows(found),
        *success_rows(methods, quick),
        *basin_rows(methods, scan_pairs(4), quick),
    ]


def time_rows(methods, cases, quick):
    """Make rows for the CPU time of a match; for ``match`` also with preprocessed clouds, as in
    SLAM."""
    ready = [(preprocess(source), preprocess(target), *rest) for source, target, *rest in cases]
    calls = {name: partial(match_all, method, cases) for name, method in methods.items()}
    calls["match, clouds preprocessed"] = partial(match_all, methods["match"], ready)
    times = cpu_times(calls, quick, seconds=20.0)
    times = {name: t / len(cases) for name, t in times.items()}
    peers = [("match", name) for name in methods if name not in ("thesis' ICP", "match")]
    return speed_rows("a match", times, peers)


def part_rows(cases, quick):
    """Make rows for the CPU time of a match's parts, and for the k-d tree of point-to-point ICP."""
    ready = [(preprocess(source), preprocess(target), guess) for source, target, guess, _ in cases]
    iterations = [match(*case).iterations for case in ready]

    def surfaces():
        for source, target, *_ in cases:
            preprocess(source)
            preprocess(target)

    def searches():
        for case, count in zip(ready, iterations, strict=True):
            for _ in range(count + 1):
                find_correspondences(*case)

    def tree():
        for source, target, *_ in cases:
            cKDTree(target).query(source)

    calls = {
        "match": partial(match_all, match, cases),
        "fitting lines to both": surfaces,
        "searching correspondences": searches,
        "building a k-d tree, one query": tree,
    }
    times = {name: t / len(cases) for name, t in cpu_times(calls, quick).items()}
    return speed_rows("parts of a match", times)


def error_rows(found):
    """Make rows for the median errors of position and heading."""
    rows = []
    for label, column, unit, scale in (
        ("position error", 0, "mm", 1e3),
        ("heading error", 1, "deg", np.degrees(1)),
    ):
        median = {name: scale * np.median(e[:, column]) for name, e in found.items()}
        reference = median["thesis' ICP"]
        rows += [
            row(f"{label}: {name}", m, unit, "thesis' ICP", reference / m)
            for name, m in median.items()
        ]
    return rows


def success_rows(methods, quick):
    """Make rows for the shares of results within 15 mm and 0.5° at 1 % noise."""
    cases = scan_pairs(7 if quick else 200, HARD)
    shares = {"match": share(errors(methods["match"], cases), TIGHT)}
    few = cases[: 21 if quick else 60]
    shares["thesis' ICP"] = share(errors(methods["thesis' ICP"], few), TIGHT)
    return [
        row(f"tight at 1 % noise: {name}", 100 * s, "%", "all", s) for name, s in shares.items()
    ]


def basin_rows(methods, cases, quick):
    """Make rows for the basin of convergence: shares of distant guesses that converge, and their
    cost."""
    tried = {
        "point to point": methods["point to point"],
        "match, no search": lambda *case: match(*case, search=0).pose,
        "match": methods["match"],
        "match, with search": lambda *case: match(*case, search=np.pi).pose,
    }
    rows = []
    for label, (turns, ways) in BASINS.items():
        far = perturbed_guesses(cases, turns, ways, 1 if quick else 12)
        for name, method in tried.items():
            converged = share(errors(method, far), FOUND)
            rows.append(row(f"basin {label}: {name}", 100 * converged, "%", "all", converged))
        calls = {name: partial(match_all, tried[name], far[:24]) for name in ("match", *tried)}
        times = {name: t / 24 for name, t in cpu_times(calls, quick, seconds=6.0).items()}
        rows += speed_rows(f"basin {label}", times)
    return rows


def perturbed_guesses(cases, turns, ways, each_cell):
    """Make scan pairs whose guesses differ from the truth by the given distance and turn."""
    rng, found = np.random.default_rng(0), []
    for turn in np.radians(turns):
        for way in ways:
            for k in rng.integers(len(cases), size=each_cell):
                source, target, _, true = cases[k]
                where = rng.uniform(-np.pi, np.pi)
                off = [way * np.cos(where), way * np.sin(where), rng.choice([-turn, turn])]
                found.append((source, target, true + off, true))
    return [found[i] for i in rng.permutation(len(found))]


def match_all(method, cases):
    """Match every case once."""
    for source, target, guess, _ in cases:
        method(source, target, guess)


if __name__ == "__main__":
    sys.exit(main({TITLE: run}, "python -m benchmarks.icp"))
