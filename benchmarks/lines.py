"""Line extraction, compared with scikit-learn's RANSAC: recall, false positives and CPU time."""

import sys
from functools import partial

import numpy as np

from benchmarks.common import Missing, cpu_times, main, row, speed_rows
from slamlab.evaluation import precision_metres, recall_metres
from slamlab.landmarks.line_fitting import Line
from slamlab.landmarks.ransac import THESIS, Ransac, lines
from slamlab.simulation import worlds
from slamlab.sources.simulated_robot import THESIS_LIDAR as LIDAR

TITLE = "Walls in scans of 400 beams, 1 % noise (CPU time, methods taking turns)"
PLACES = ("situation-1", "situation-2", "corridor", "room", "table-legs", "polygon")
PERIOD = 0.1  # of a scan: the lidar turns ten times a second [s]
OURS, SMOLEC, PEER = "slamlab", "thesis' parameters", "scikit-learn, line by line"


def regressor():
    """Import scikit-learn's RANSACRegressor, which only this benchmark needs."""
    try:
        from sklearn.linear_model import RANSACRegressor
    except ImportError:
        raise Missing(
            "scikit-learn, the peer, is not installed: python -m pip install scikit-learn"
        ) from None
    return RANSACRegressor


def line_by_line(ransac, scan, rng):
    """Extract lines by a general RANSAC: find the best line y = a x + b, remove its points, repeat.

    It ignores neighbourhoods and range-dependent noise; its inlier band is the noise at 3 m.
    """
    points, found = scan.points(), []
    while len(points) >= 21:
        fit = ransac(
            residual_threshold=0.06, min_samples=2, random_state=int(rng.integers(2**31))
        ).fit(points[:, :1], points[:, 1])
        on = fit.inlier_mask_
        if on.sum() < 21:
            break
        a, b = float(fit.estimator_.coef_[0]), float(fit.estimator_.intercept_)
        way = np.array([1, a]) / np.hypot(1, a)
        along = points[on] @ way
        foot = np.array([-a, 1]) * b / (1 + a * a)
        ends = foot + np.outer([along.min(), along.max()], way)
        found.append(Line(np.zeros(2), np.eye(2), ends, np.flatnonzero(on)))
        points = points[~on]
    return found


def scenes(name, count):
    """Make test scenes, scans at random free positions of a world: (world, pose, scan)."""
    world, rng, found = worlds.by_name(name), np.random.default_rng(1), []
    corners = world.walls.reshape(-1, 2)
    while len(found) < count:
        place = rng.uniform(corners.min(axis=0), corners.max(axis=0))
        around = world.cast(place, np.linspace(0, 2 * np.pi, 90))
        if np.isfinite(around).all() and around.min() > 0.3:
            pose = np.array([*place, rng.uniform(-np.pi, np.pi)])
            found.append((world, pose, LIDAR.scan(world, pose, rng)))
    return found


def shares(method, cases):
    """Return the recall, the share of visible wall length that was found, and the false share of
    line length."""
    sums = np.zeros(4)
    for world, pose, scan in cases:
        walls = method(scan, np.random.default_rng(0))
        sums += *recall_metres(world, pose, scan, walls), *precision_metres(world, pose, walls)
    seen, found, right, wrong = sums
    return found / seen, wrong / max(right + wrong, 1e-9)


def run(quick):
    """Make rows for recall, false share and time."""
    methods = {
        SMOLEC: lambda scan, rng: lines(scan, LIDAR.model, rng, THESIS),
        OURS: lambda scan, rng: lines(scan, LIDAR.model, rng, Ransac()),
        PEER: partial(line_by_line, regressor()),
    }
    rows, timed = [], []
    for name in PLACES:
        cases = scenes(name, 10 if quick else 60)
        timed += cases[:2]
        results = {who: shares(method, cases) for who, method in methods.items()}
        reference = results[SMOLEC]
        for who, (found, false) in results.items():
            rows.append(
                row(f"{name}: found: {who}", 100 * found, "%", SMOLEC, found / reference[0])
            )
            ratio = reference[1] / false if false else np.inf
            rows.append(row(f"{name}: false: {who}", 100 * false, "%", SMOLEC, ratio))
    calls = {who: partial(each, method, timed) for who, method in methods.items()}
    times = {who: t / len(timed) for who, t in cpu_times(calls, quick).items()}
    rows += speed_rows("a scan", times, [(OURS, PEER)])
    budget = PERIOD / 10
    rows.append(
        row("a scan: slamlab", 1e3 * times[OURS], "ms", "period / 10", budget / times[OURS])
    )
    return rows


def each(method, cases):
    """Extract the lines of every scan once."""
    for _, _, scan in cases:
        method(scan, np.random.default_rng(0))


if __name__ == "__main__":
    sys.exit(main({TITLE: run}, "python -m benchmarks.lines"))
