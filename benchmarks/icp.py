"""Scan matching (ICP) against the thesis' ICP, and small_gicp and Open3D where installed.

What a match cannot go below is told by its parts. With clouds as they come, about half of it
goes into the lines that are fitted to both; a SLAM fits them once a scan. Its half a dozen looks at
all pairs, made by bearing, cost together what a KD-tree costs to be built and asked once; the
thesis' way builds and asks one in each of its dozens of rounds.
"""

import sys
from dataclasses import replace
from functools import partial

import numpy as np
from scipy.spatial import cKDTree

from benchmarks import icp_peers
from benchmarks.common import cpu_times, main, row, speed_rows
from slamlab.geometry import between, transform
from slamlab.scanmatching import match, point_to_line, point_to_point, rigid_fit, surface
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


def thesis_way(neighbours, source, target, guess):
    """ICP as the thesis' listing goes about it: fit scikit-learn's search, ask it, every round."""
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
    """Pairs of scans with their guess and true motion: (source, target, guess, true)."""
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
    """(n, 2) distance and turn of a method's poses from the true ones [m, rad]."""
    e = np.array([between(true, method(*clouds, guess)) for *clouds, guess, true in cases])
    return np.column_stack([np.hypot(e[:, 0], e[:, 1]), np.abs(e[:, 2])])


def share(found, limits):
    """Share of errors within limits [1]."""
    return float((found < limits).all(axis=1).mean())


def run(quick):
    """Rows of time, of error, of success, and of the basin."""
    methods = {
        "thesis' way": partial(thesis_way, icp_peers.sklearn_neighbours()),
        "point to point": lambda *case: point_to_point(*case, tolerance=TOLERANCE).pose,
        "point to line": lambda *case: point_to_line(*case).pose,
        "match": lambda *case: match(*case).pose,
        **icp_peers.peers(),
    }
    cases = scan_pairs(4 if quick else 30)
    found = {name: errors(method, cases) for name, method in methods.items()}
    np.testing.assert_allclose(found["point to point"], found["thesis' way"], atol=1e-3)
    return [
        *time_rows(methods, cases[:6], quick),
        *part_rows(cases[:6], quick),
        *error_rows(found),
        *success_rows(methods, quick),
        *basin_rows(methods, scan_pairs(4), quick),
    ]


def time_rows(methods, cases, quick):
    """CPU time of a match; of ``match`` also with both clouds made ready before, as SLAM has it."""
    ready = [(surface(source), surface(target), *rest) for source, target, *rest in cases]
    calls = {name: partial(match_all, method, cases) for name, method in methods.items()}
    calls["match, clouds made ready"] = partial(match_all, methods["match"], ready)
    times = cpu_times(calls, quick, seconds=20.0)
    times = {name: t / len(cases) for name, t in times.items()}
    peers = [("match", name) for name in methods if name not in ("thesis' way", "match")]
    return speed_rows("a match", times, peers)


def part_rows(cases, quick):
    """CPU time of a match's parts, and the tree that each round of point to point asks."""
    ready = [(surface(source), surface(target), guess) for source, target, guess, _ in cases]
    rounds = [match(*case).rounds for case in ready]

    def surfaces():
        for source, target, *_ in cases:
            surface(source)
            surface(target)

    def looks():
        for case, count in zip(ready, rounds, strict=True):
            for _ in range(count + 1):
                find_correspondences(*case)

    def tree():
        for source, target, *_ in cases:
            cKDTree(target).query(source)

    calls = {
        "match": partial(match_all, match, cases),
        "fitting lines to both": surfaces,
        "looking at all pairs": looks,
        "building a tree, asking it once": tree,
    }
    times = {name: t / len(cases) for name, t in cpu_times(calls, quick).items()}
    return speed_rows("parts of a match", times)


def error_rows(found):
    """Median errors of position and of heading."""
    rows = []
    for label, column, unit, scale in (
        ("position error", 0, "mm", 1e3),
        ("heading error", 1, "deg", np.degrees(1)),
    ):
        median = {name: scale * np.median(e[:, column]) for name, e in found.items()}
        reference = median["thesis' way"]
        rows += [
            row(f"{label}: {name}", m, unit, "thesis' way", reference / m)
            for name, m in median.items()
        ]
    return rows


def success_rows(methods, quick):
    """Shares of results within 15 mm and 0.5° at 1 % noise."""
    cases = scan_pairs(7 if quick else 200, HARD)
    shares = {"match": share(errors(methods["match"], cases), TIGHT)}
    few = cases[: 21 if quick else 60]
    shares["thesis' way"] = share(errors(methods["thesis' way"], few), TIGHT)
    return [
        row(f"tight at 1 % noise: {name}", 100 * s, "%", "all", s) for name, s in shares.items()
    ]


def basin_rows(methods, cases, quick):
    """Basin of convergence: shares of far guesses that converge, their cost beside a near one."""
    tried = {
        "point to point": methods["point to point"],
        "match, no search": lambda *case: match(*case, search=0).pose,
        "match": methods["match"],
        "match, search asked for": lambda *case: match(*case, search=np.pi).pose,
    }
    rows = []
    for label, (turns, ways) in BASINS.items():
        far = perturbed_guesses(cases, turns, ways, 1 if quick else 12)
        for name, method in tried.items():
            home = share(errors(method, far), FOUND)
            rows.append(row(f"basin {label}: {name}", 100 * home, "%", "all", home))
        calls = {name: partial(match_all, tried[name], far[:24]) for name in ("match", *tried)}
        times = {name: t / 24 for name, t in cpu_times(calls, quick, seconds=6.0).items()}
        rows += speed_rows(f"basin {label}", times)
    return rows


def perturbed_guesses(cases, turns, ways, each_cell):
    """Scan pairs with guesses perturbed so far off the truth, to either side, in any direction."""
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
