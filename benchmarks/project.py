"""The final project's score between seeds: the same code in other worlds of the same families.

Worlds are drawn each from a stream of its own, so any world of a family and length may stand in a
set for any other. From the points of all worlds sets are put together by chance, and scored: the
standard deviation of the scores is that between seeds, known better than from the seeds alone.
"""

import sys
from concurrent.futures import ProcessPoolExecutor

import numpy as np

from benchmarks.common import main, row
from course.project.solution import MySlam
from slamlab.contest.ranking import scores
from slamlab.project.baselines import BASELINES
from slamlab.project.drawing import WORLDS_PER_FAMILY, draw_family
from slamlab.project.driving import Budget, drive
from slamlab.project.scores import prepare
from slamlab.project.world_families import FAMILIES

TITLE = "Project: score between seeds (points of 100; asked is a standard deviation below 3)"
SEEDS, QUICK_SEEDS = 20, 2
ASKED = 3.0  # points
SETS = 4000  # put together by chance
SOLUTION = "solution"


def points_of_seed(seed):
    """What the baselines and the solution score in the worlds of a seed.

    Returns
    -------
    {who: (families, worlds)} points
    """
    found = {who: [] for who in (*BASELINES, SOLUTION)}
    for family in FAMILIES.values():
        for world in draw_family(family, seed, WORLDS_PER_FAMILY):
            arena = prepare(world)
            mine = drive(MySlam, world, Budget(*[np.inf] * 4))
            for who, driven in (arena.drives | {SOLUTION: mine}).items():
                found[who].append(arena.judge(driven).points)
    return {
        who: np.reshape(points, (len(FAMILIES), WORLDS_PER_FAMILY)) for who, points in found.items()
    }


def between_seeds(points, rng):
    """Standard deviation of the score between seeds, from (seeds, families, count) points."""
    seeds, families, count = points.shape
    drawn = rng.integers(seeds, size=(SETS, families, count))
    sets = points[drawn, np.arange(families)[:, None], np.arange(count)]
    return scores(sets).std() * np.sqrt(seeds / (seeds - 1))


def run(quick):
    """Rows of the benchmark."""
    if quick:
        return rows([points_of_seed(seed) for seed in range(QUICK_SEEDS)])
    with ProcessPoolExecutor() as processes:  # points are counted, not seconds
        return rows(list(processes.map(points_of_seed, range(SEEDS))))


def rows(measured):
    """Rows for the points of some seeds: list of what :func:`points_of_seed` gives."""
    rng, found = np.random.default_rng(0), []
    for who in measured[0]:
        points = np.array([of_seed[who] for of_seed in measured])
        found.append(row(f"{who}: score", scores(points).mean(), "points", "100", 1))
        for how, spread in (
            ("of sets put together", between_seeds(points, rng)),
            (f"of {len(measured)} seeds", scores(points).std(ddof=1)),
        ):
            ratio = ASKED / max(spread, 1e-9)
            found.append(row(f"{who}: deviation {how}", spread, "points", f"{ASKED:g}", ratio))
    return found


if __name__ == "__main__":
    sys.exit(main({TITLE: run}, "python -m benchmarks.project"))
