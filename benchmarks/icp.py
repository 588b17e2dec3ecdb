"""Scan matching against the thesis' way: nearest neighbours refitted in every round."""

import sys
from functools import partial

import numpy as np

from benchmarks.common import Missing, cpu_times, main, row, speed_rows
from slamlab.geometry import between, transform
from slamlab.scanmatching import point_to_line, point_to_point, rigid_fit
from slamlab.sources.simulation import POLYGON_WRONG_STEPS, simulation, turn_then_drive

TITLE = "Scan matching on the polygon, wrong odometry as the guess (CPU time, methods taking turns)"
TOLERANCE = 1e-6  # the thesis' 0.001 mm


def sklearn_neighbours():
    """scikit-learn's NearestNeighbors, which only this benchmark needs."""
    try:
        from sklearn.neighbors import NearestNeighbors
    except ImportError:
        raise Missing(
            "compares with scikit-learn, which is not here: python -m pip install scikit-learn"
        ) from None
    return NearestNeighbors


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


def problems(count):
    """Pairs of scans with their guess and true motion: (source, target, guess, true)."""
    guesses, found = turn_then_drive(POLYGON_WRONG_STEPS), []
    for seed in range(count):
        run = simulation("polygon-wrong", np.random.default_rng(seed))
        clouds = [reading.scan.points() for reading in run]
        poses = run.truth.poses
        for i, guess in enumerate(guesses):
            true = between(poses[i], poses[i + 1])
            found.append((clouds[i + 1], clouds[i], guess, true))
    return found


def run(quick):
    """Rows of time and of error."""
    cases = problems(2 if quick else 10)
    methods = {
        "thesis' way": partial(thesis_way, sklearn_neighbours()),
        "point to point": lambda *case: point_to_point(*case, tolerance=TOLERANCE).pose,
        "point to line": lambda *case: point_to_line(*case).pose,
    }
    errors = {
        name: np.array([between(true, match(*clouds, guess)) for *clouds, guess, true in cases])
        for name, match in methods.items()
    }
    np.testing.assert_allclose(errors["point to point"], errors["thesis' way"], atol=1e-3)
    calls = {name: partial(each, match, cases[:3]) for name, match in methods.items()}
    times = {name: t / 3 for name, t in cpu_times(calls, quick, seconds=12.0).items()}
    rows = speed_rows("a match", times)
    for label, size, unit, scale in (
        ("position error", lambda e: np.hypot(e[:, 0], e[:, 1]), "mm", 1e3),
        ("heading error", lambda e: np.abs(e[:, 2]), "deg", np.degrees(1)),
    ):
        median = {name: scale * np.median(size(e)) for name, e in errors.items()}
        reference = median["thesis' way"]
        rows += [
            row(f"{label}: {name}", m, unit, "thesis' way", reference / m)
            for name, m in median.items()
        ]
    return rows


def each(match, cases):
    """Match every case once."""
    for source, target, guess, _ in cases:
        match(source, target, guess)


if __name__ == "__main__":
    sys.exit(main({TITLE: run}, "python -m benchmarks.icp"))
