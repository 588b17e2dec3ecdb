"""Families that the scale was not made with: it orders estimators there, too, and 0 is odometry."""

from functools import cache

import numpy as np
import pytest

from classroom.project import furniture_placement
from classroom.project.estimator_runs import Budget, run_estimator
from classroom.project.scores import prepare
from classroom.project.world_generation import generate_world
from classroom.project.world_parameters import WorldFamily
from course.project.solution import MySlam as Solution
from course.project.template import MySlam as Template
from slamlab.geometry import compose, wrap
from tests.classroom.project.students import CorrelativeGrid, KeyframeIcp

RING = WorldFamily("ring", plans=(("crrrc", "crc"),), closed=0.5, bare=True)
CROWDED = WorldFamily("crowded", plans=(("rcr", "rcr"),), slip=0.02)
YARD = WorldFamily("yard", plans=(("rcccr", "rcccr"),), landmarks=1, slip=0.03)
LIDAR = (Template, CorrelativeGrid, KeyframeIcp, Solution)


class Rememberer(Template):
    """Landmarks: keeps each where it was seen first, and lies back on those that it knows."""

    def __init__(self):
        super().__init__()
        self.known = {}

    def step(self, reading):
        guess, z = compose(self.pose, reading.odometry), reading.observations.z
        seen = z[:, :1] * np.column_stack([np.cos(z[:, 1]), np.sin(z[:, 1])])
        ids = reading.observations.ids.tolist()
        both = [k for k, i in enumerate(ids) if i in self.known]
        if len(both) > 1:
            old = np.array([self.known[ids[k]] for k in both])
            p, q = seen[both] - seen[both].mean(0), old - old.mean(0)
            turn = np.arctan2(np.sum(p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]), np.sum(p * q))
            turn = guess[2] + 0.5 * wrap(float(turn - guess[2]))
            c, s = np.cos(turn), np.sin(turn)
            place = old.mean(0) - np.array([[c, -s], [s, c]]) @ seen[both].mean(0)
            guess = np.array([*(0.5 * (guess[:2] + place)), turn])
        elif both:
            guess[:2] += 0.5 * (
                self.known[ids[both[0]]] - compose(guess, [*seen[both[0]], 0.0])[:2]
            )
        self.pose = guess
        self._poses.append(guess)
        for k, i in enumerate(ids):
            self.known.setdefault(i, compose(guess, [*seen[k], 0.0])[:2])

    def map(self):
        return np.array(list(self.known.values()))


@cache
def prepared_world(family):
    """A world of a family, the same for all tests."""
    return prepare(generate_world(family, np.random.default_rng(8), 30.0))


def results(family, makers):
    """What some estimators make of it."""
    world, free = prepared_world(family), Budget(*[np.inf] * 4)
    return [world.judge(run_estimator(make, world.readings, free)) for make in makers]


@pytest.fixture
def crowded(monkeypatch):
    monkeypatch.setattr(furniture_placement, "MAX_PIECES", 14)
    monkeypatch.setattr(furniture_placement, "TRIES", 40)


@pytest.mark.slow
@pytest.mark.usefixtures("crowded")
@pytest.mark.parametrize("family", [RING, CROWDED], ids=lambda family: family.name)
def test_in_new_families_points_follow_errors_and_the_marks_hold(family):
    found = results(family, LIDAR)
    assert not any(result.mistakes for result in found)
    assert found[0].points == 0
    assert min(result.points for result in found[1:]) > 10
    gains = [result.measures.gain for result in found]
    tracks = [np.interp(gain, prepared_world(family).scale[0], (0, 55, 85, 100)) for gain in gains]
    assert np.all(np.diff(np.array(tracks)[np.argsort(gains)]) >= 0)
    runs = prepared_world(family).runs
    icp, graph = (prepared_world(family).judge(runs[name]).points for name in ("icp", "graph"))
    assert 0 < icp <= 55
    assert icp < graph <= 85


def test_among_few_landmarks_where_the_marks_fail_a_better_track_still_earns_points():
    wheels, rememberer = results(YARD, (Template, Rememberer))
    assert wheels.points == 0
    assert rememberer.measures.gain > 0.2
    assert rememberer.points > 20
    steps = np.diff(prepared_world(YARD).scale[0])
    assert (steps > 0.2).all()  # a mark that fails makes no step of the scale steep
