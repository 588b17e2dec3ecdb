"""The score of an estimator: the mean over families of worlds of the median points."""

from dataclasses import dataclass

import numpy as np

from classroom.project import estimate_errors
from classroom.project.baselines import BASELINES
from classroom.project.estimator_runs import Budget, EstimatorRun, run_estimator
from classroom.project.hidden_worlds import HiddenWorld
from classroom.project.point_scale import Metrics, compute_log_metrics, marks, measure, points_of
from classroom.project.recorded_logs import RecordedLog
from classroom.project.world_generation import WORLDS_PER_FAMILY, generate_worlds
from classroom.project.world_parameters import WORLD_FAMILIES


@dataclass(frozen=True)
class PreparedWorld:
    """A world with the runs of the baselines and the scale that follows from these runs."""

    world: HiddenWorld | RecordedLog
    readings: tuple  # of the world, generated once for all estimators
    runs: dict[str, EstimatorRun]  # of the baselines, by name
    walls: tuple | None  # of estimate_errors.walls_to_map; None of a log
    scale: tuple  # of points.marks

    def judge(self, run):
        found = _measured(run, self.world, self.runs["odometry"], self.walls)
        points = points_of(found, self.scale)
        return WorldResult(self.world.name, points, found, run.mistakes, run.seconds)


@dataclass(frozen=True)
class WorldResult:
    """The result of an estimator in one world."""

    family: str
    points: float  # 0 to 100
    measures: Metrics
    mistakes: tuple[str, ...]  # error messages
    seconds: float  # CPU time


def prepare(world):
    """Run the baselines on a HiddenWorld or RecordedLog, and return a PreparedWorld."""
    unlimited = Budget(*[np.inf] * 4)
    readings = tuple(world)
    runs = {name: run_estimator(make, readings, unlimited) for name, make in BASELINES.items()}
    walls = None if world.truth is None else estimate_errors.walls_to_map(world)
    measured = {name: _measured(run, world, runs["odometry"], walls) for name, run in runs.items()}
    return PreparedWorld(world, readings, runs, walls, marks(**measured))


def _measured(run, world, odometry, walls):
    if world.truth is None:
        return compute_log_metrics(run, world, odometry)
    return measure(run, world, odometry, walls)


def prepared_worlds(seed, families=None, count=WORLDS_PER_FAMILY):
    """Draw and prepare the worlds of a seed, and yield PreparedWorlds. families : None for all."""
    for family in WORLD_FAMILIES.values() if families is None else families:
        for world in generate_worlds(family, seed, count):
            yield prepare(world)


def judge(make, prepared, budget=None):
    """Judge an estimator (its class) in PreparedWorlds within one budget; return WorldResults."""
    budget = budget or Budget()
    return [
        prepared_world.judge(run_estimator(make, prepared_world.readings, budget))
        for prepared_world in prepared
    ]


def score(results):
    """Compute the score, 0 to 100: the mean over families of the median points."""
    return float(np.mean(list(by_family(results).values())))


def by_family(results):
    families = {}
    for result in results:
        families.setdefault(result.family, []).append(result.points)
    return {name: float(np.median(points)) for name, points in families.items()}
