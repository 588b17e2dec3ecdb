"""Ray casting, compared with a plain Python loop and a dense NumPy version."""

import math
import sys

import numpy as np

from benchmarks.common import cpu_times, main, speed_rows
from slamlab.simulation.worlds.ray_casting import cast

TITLE = "Ray casting (CPU time, one thread, methods taking turns)"
CASES = [(400, 10), (400, 100), (400, 1000), (400, 10_000), (3600, 20)]


def python_loop(position, directions, walls):
    """Cast rays by a plain loop: every beam and every wall, one at a time."""
    px, py = position
    ranges = []
    for direction in directions:
        ux, uy = math.cos(direction), math.sin(direction)
        nearest = math.inf
        for x1, y1, x2, y2 in walls:
            wx, wy = x2 - x1, y2 - y1
            ax, ay = x1 - px, y1 - py
            sine = ux * wy - uy * wx
            if sine == 0:
                continue
            t = (ax * wy - ay * wx) / sine
            s = (ax * uy - ay * ux) / sine
            if t >= 0 and 0 <= s <= 1 and t < nearest:
                nearest = t
        ranges.append(nearest)
    return ranges


def dense_numpy(position, directions, walls):
    """Cast rays by dense NumPy: every beam and every wall in one table."""
    ux, uy = np.cos(directions)[:, None], np.sin(directions)[:, None]
    a, w = walls[:, :2] - position, walls[:, 2:] - walls[:, :2]
    with np.errstate(divide="ignore", invalid="ignore"):
        sine = ux * w[:, 1] - uy * w[:, 0]
        t = (a[:, 0] * w[:, 1] - a[:, 1] * w[:, 0]) / sine
        s = (a[:, 0] * uy - a[:, 1] * ux) / sine
        hit = (t >= 0) & (s >= 0) & (s <= 1)
    return np.where(hit, t, np.inf).min(axis=1)


def scene(beams, count):
    """Make a test scene: a sensor among random walls of 0.5 to 3 m in a square of 20 x 20 m."""
    rng = np.random.default_rng([beams, count])
    centres, turn = rng.uniform(-10, 10, (count, 2)), rng.uniform(0, np.pi, count)
    half = rng.uniform(0.25, 1.5, (count, 1)) * np.column_stack([np.cos(turn), np.sin(turn)])
    directions = np.linspace(-np.pi, np.pi, beams, endpoint=False) + 1e-3
    return np.array([0.31, -0.17]), directions, np.hstack([centres - half, centres + half])


def run(quick):
    """Make rows for all cases; first check that the methods' results agree."""
    rows = []
    for beams, count in CASES:
        position, directions, walls = scene(beams, count)
        lists = position.tolist(), directions.tolist(), walls.tolist()  # a loop's best food
        methods = {
            "Python loop": lambda lists=lists: python_loop(*lists),
            "dense NumPy": lambda p=position, d=directions, w=walls: dense_numpy(p, d, w),
            "slamlab": lambda p=position, d=directions, w=walls: cast(p, d, w),
        }
        ranges = methods["Python loop"]()
        for name in ("dense NumPy", "slamlab"):
            np.testing.assert_allclose(methods[name](), ranges, rtol=1e-9, err_msg=name)
        times = cpu_times(methods, quick)
        beside = [("slamlab", "dense NumPy")]
        rows += speed_rows(f"{beams} beams, {count} walls", times, beside)
    return rows


if __name__ == "__main__":
    sys.exit(main({TITLE: run}, "python -m benchmarks.raycast"))
