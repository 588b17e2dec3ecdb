"""Scores: an estimator judged in all worlds of some families; in each the median counts."""

from dataclasses import dataclass

import numpy as np

from slamlab.project import drive_errors
from slamlab.project.baselines import BASELINES
from slamlab.project.drawing import WORLDS_PER_FAMILY, draw_family
from slamlab.project.driving import Budget, Drive, drive
from slamlab.project.hidden_worlds import HiddenWorld
from slamlab.project.points import Measures, marks, measure, measure_log, points_of
from slamlab.project.recorded_logs import RecordedLog
from slamlab.project.world_families import FAMILIES


@dataclass(frozen=True)
class Arena:
    """A world with what it takes to judge in it: the baselines' drives and the scale they make.

    Parameters
    ----------
    world : HiddenWorld or RecordedLog
    readings : tuple of Reading, those of the world, made once for all who are judged
    drives : dict, baseline's name to its Drive
    walls : what there is to be mapped, see :func:`slamlab.project.drive_errors.to_be_mapped`;
        None of a log
    scale : the marks, see :func:`slamlab.project.points.marks`
    """

    world: HiddenWorld | RecordedLog
    readings: tuple
    drives: dict[str, Drive]
    walls: tuple | None
    scale: tuple

    def judge(self, driven):
        """Measure a drive in this world and give its points.

        Parameters
        ----------
        driven : Drive

        Returns
        -------
        Result
        """
        found = _measured(driven, self.world, self.drives["odometry"], self.walls)
        points = points_of(found, self.scale)
        return Result(self.world.name, points, found, driven.mistakes, driven.seconds)


@dataclass(frozen=True)
class Result:
    """What an estimator made of one world.

    Parameters
    ----------
    family : str
    points : float, 0 to 100
    measures : Measures
    mistakes : tuple of str, a sentence each
    seconds : float of CPU
    """

    family: str
    points: float
    measures: Measures
    mistakes: tuple[str, ...]
    seconds: float


def prepare(world):
    """Drive the baselines through a world: what is the same for all who are judged in it.

    Parameters
    ----------
    world : HiddenWorld or RecordedLog

    Returns
    -------
    Arena
    """
    unlimited = Budget(*[np.inf] * 4)
    readings = tuple(world)
    drives = {name: drive(make, readings, unlimited) for name, make in BASELINES.items()}
    walls = None if world.truth is None else drive_errors.to_be_mapped(world)
    measured = {
        name: _measured(driven, world, drives["odometry"], walls) for name, driven in drives.items()
    }
    return Arena(world, readings, drives, walls, marks(**measured))


def _measured(driven, world, odometry, walls):
    if world.truth is None:
        return measure_log(driven, world, odometry)
    return measure(driven, world, odometry, walls)


def arenas(seed, families=None, count=WORLDS_PER_FAMILY):
    """Draw the worlds of a contest, and prepare each.

    Parameters
    ----------
    seed : int, of any size
    families : sequence of Family, or None for all of FAMILIES
    count : int, worlds a family

    Yields
    ------
    Arena
    """
    for family in FAMILIES.values() if families is None else families:
        for world in draw_family(family, seed, count):
            yield prepare(world)


def judge(make, prepared, budget=None):
    """Judge an estimator in some worlds, with one budget for all of them.

    Parameters
    ----------
    make : callable that makes the student's estimator, its class
    prepared : iterable of Arena
    budget : Budget, or None for the usual one

    Returns
    -------
    list of Result
    """
    budget = budget or Budget()
    return [arena.judge(drive(make, arena.readings, budget)) for arena in prepared]


def score(results):
    """The score: in each family the median of its worlds counts, and all families alike.

    Parameters
    ----------
    results : list of Result

    Returns
    -------
    float, 0 to 100
    """
    return float(np.mean(list(by_family(results).values())))


def by_family(results):
    """The median of each family's worlds.

    Parameters
    ----------
    results : list of Result

    Returns
    -------
    dict, family's name to points
    """
    families = {}
    for result in results:
        families.setdefault(result.family, []).append(result.points)
    return {name: float(np.median(points)) for name, points in families.items()}
