"""Estimators as students hand in: good ones rank as their errors do, cheaters gain nothing.

What a sandbox has to keep from them is tested with the sandbox; here they are run as they are.
"""

import ast
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import course.project
from classroom.project.baselines import BASELINES
from classroom.project.estimator_runs import Budget, run_estimator
from classroom.project.point_scale import Metrics, points_of
from classroom.project.scores import prepare
from classroom.project.world_generation import generate_world, generate_worlds
from classroom.project.world_parameters import LANDMARKS, WorldFamily
from course.project import reference_estimators
from course.project.solution import MySlam as Solution
from course.project.template import MySlam as Template
from tests.classroom.project.students import (
    CorrelativeGrid,
    Diverges,
    KeyframeIcp,
    WallHeading,
    Wheels,
)

LOOP = WorldFamily("loop", plans=(("crrc", "crc"),))
UNLIMITED = Budget(*[np.inf] * 4)
ALLOWED = {"numpy", "scipy", "slamlab.geometry", "slamlab.layers"}
ALLOWED |= {"slamlab.simulation.worlds.ray_casting"}
SOURCES = sorted(Path(course.project.__file__).parent.rglob("*.py"))
GOOD = (Solution, *reference_estimators.BANK)


@cache
def prepared_world(seed):
    """A small world, the same for all tests that name its seed."""
    return prepare(generate_world(LOOP, np.random.default_rng(seed), 25.0))


@cache
def driven(make, seed=2):
    return run_estimator(make, prepared_world(seed).world, UNLIMITED)


def result(make, seed=2):
    """What an estimator makes of a small world."""
    return prepared_world(seed).judge(driven(make, seed))


@pytest.mark.parametrize("source", SOURCES, ids=lambda path: path.stem)
def test_a_reference_estimator_imports_only_allowed_modules(source):
    for node in ast.walk(ast.parse(source.read_text("utf-8"))):
        if isinstance(node, ast.ImportFrom):
            own = node.module.startswith("course.project")
            assert own or node.module in ALLOWED or node.module.split(".")[0] in ALLOWED
        if isinstance(node, ast.Import):
            assert {alias.name for alias in node.names} <= ALLOWED


@pytest.mark.slow
@pytest.mark.parametrize("make", GOOD)
def test_a_good_estimator_is_far_better_than_odometry(make):
    found = result(make)
    assert not found.mistakes
    assert found.measures.completeness == 1
    assert found.points > 35
    assert (found.measures.errors < result(BASELINES["odometry"]).measures.errors).all()


def test_the_solution_is_good_and_not_perfect():
    assert 60 < result(Solution).points < 100


def test_good_estimators_are_ranked_as_their_errors_are():
    """By what the trajectory is worth; a map or a false claim may change places."""
    measured = [result(make).measures for make in (*GOOD, *BASELINES.values())]
    alike = [Metrics(m.gain, m.errors, 0.0, 1.0, np.nan) for m in measured]
    worth = [points_of(m, prepared_world(2).scale) for m in alike]
    by_gain = np.argsort([m.gain for m in measured])
    assert (np.diff(np.array(worth)[by_gain]) >= 0).all()


def test_scores_order_students_as_their_errors_do():
    makers = (Wheels, WallHeading, CorrelativeGrid, KeyframeIcp)
    by_error = sorted(makers, key=lambda make: -result(make).measures.gain)
    assert sorted(makers, key=lambda make: -result(make).points) == by_error
    assert result(Wheels).points == 0
    assert result(WallHeading).points > 5
    assert result(KeyframeIcp).points > 40


def test_a_diverging_estimator_scores_0_and_its_non_finite_poses_are_reported():
    found = result(Diverges)
    assert found.points == 0
    assert any("poses are not finite" in mistake for mistake in found.mistakes)


def test_an_estimator_for_lidars_runs_among_landmarks_too():
    world = next(generate_worlds(LANDMARKS, 0, count=1))
    for make in (Template, *GOOD):
        assert not run_estimator(make, world, UNLIMITED).mistakes


class Memoriser(Template):
    """Plays back the trajectory of a practice world it knows."""

    def trajectory(self):
        poses = prepared_world(2).world.truth.poses
        return poses[np.arange(len(self._poses)) % len(poses)]


class NotANumber(Template):
    """Returns NaN everywhere but at the start."""

    def step(self, reading):
        super().step(reading)
        if len(self._poses) > 5:
            self.pose = self._poses[-1] = np.full(3, np.nan)


class Oracle(Template):
    """Looks for the truth, or what comes, in what it is given."""

    def step(self, reading):
        super().step(reading)
        for name in ("truth", "poses", "world", "floor", "seed", "next", "readings"):
            assert not hasattr(reading, name)
            assert not hasattr(reading.scan, name)


class Vain(Template):
    """Odometry that claims to be exact."""

    def step(self, reading):
        super().step(reading)
        self.covariance = 1e-9 * np.eye(3)


class Flooder(Template):
    """A map with a point everywhere."""

    def map(self):
        side = np.arange(-10, 10, 0.1)
        return np.stack(np.meshgrid(side, side), axis=-1).reshape(-1, 2)


@pytest.mark.parametrize("make", [Template, Memoriser, NotANumber, Oracle, Vain, Flooder])
def test_a_cheater_gains_nothing_over_odometry(make):
    assert result(make, seed=3).points == 0


def test_an_inconsistent_covariance_costs_a_good_estimator_points():
    run = driven(Solution)
    silent, boasting = (
        replace(run, covariances=np.broadcast_to(P, run.covariances.shape))
        for P in (np.full((3, 3), np.nan), 1e-12 * np.eye(3))
    )
    points = [prepared_world(2).judge(each).points for each in (silent, boasting)]
    assert points[1] == pytest.approx(points[0] - 20)


def test_an_estimator_that_wastes_cpu_loses_the_remaining_worlds():
    class Burner(Solution):
        def step(self, reading):
            super().step(reading)
            clock.append(0.9)

    clock = []
    budget = Budget(total=0.95 * len(prepared_world(2).world), clock=lambda: sum(clock))
    world = prepared_world(2).world
    results = [prepared_world(2).judge(run_estimator(Burner, world, budget)) for _ in range(2)]
    assert results[0].points == result(Solution).points
    assert results[1].points < 0.2 * results[0].points
