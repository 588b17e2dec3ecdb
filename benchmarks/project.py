"""Standard deviation of the final project's score between seeds, in worlds of the same families.

Each world is drawn from its own random stream, so any world of a family and length may be in a set
for any other. Random sets are drawn from all worlds and scored. The standard deviation of their
scores estimates that between seeds more precisely than the seeds alone.
"""

import sys
from concurrent.futures import ProcessPoolExecutor

import numpy as np

from benchmarks.common import main, row
from classroom.contest.ranking import scores
from classroom.project.baselines import BASELINES
from classroom.project.estimator_runs import Budget, run_estimator
from classroom.project.scores import prepare
from classroom.project.world_generation import WORLDS_PER_FAMILY, generate_worlds
from classroom.project.world_parameters import WORLD_FAMILIES
from course.project.solution import MySlam

TITLE = "Project: score between seeds (points of 100; goal: a standard deviation below 3)"
SEEDS, QUICK_SEEDS = 20, 2
ASKED = 3.0  # points
SETS = 4000  # put together by chance
SOLUTION = "solution"


def points_of_seed(seed):
    """Score the baselines and the solution in the worlds of a seed.

    Returns
    -------
    {who: (families, worlds)} points
    """
    found = {who: [] for who in (*BASELINES, SOLUTION)}
    for family in WORLD_FAMILIES.values():
        for world in generate_worlds(family, seed, WORLDS_PER_FAMILY):
            prepared_world = prepare(world)
            mine = run_estimator(MySlam, world, Budget(*[np.inf] * 4))
            for who, run in (prepared_world.runs | {SOLUTION: mine}).items():
                found[who].append(prepared_world.judge(run).points)
    return {
        who: np.reshape(points, (len(WORLD_FAMILIES), WORLDS_PER_FAMILY))
        for who, points in found.items()
    }


def between_seeds(points, rng):
    """Return the score's standard deviation between seeds, from points (seeds, families, count)."""
    seeds, families, count = points.shape
    drawn = rng.integers(seeds, size=(SETS, families, count))
    sets = points[drawn, np.arange(families)[:, None], np.arange(count)]
    return scores(sets).std() * np.sqrt(seeds / (seeds - 1))


def run(quick):
    """Make the rows of the benchmark."""
    if quick:
        return rows([points_of_seed(seed) for seed in range(QUICK_SEEDS)])
    with ProcessPoolExecutor() as processes:  # points are counted, not seconds
        return rows(list(processes.map(points_of_seed, range(SEEDS))))


def rows(measured):
    """Make rows from the points of some seeds, a list of results of :func:`points_of_seed`."""
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
