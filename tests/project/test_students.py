"""Students whom nobody foresaw: scores rank them as their errors do, each is told what is wrong."""

from functools import cache

import numpy as np
import pytest

from slamlab.project.drawing import draw_world
from slamlab.project.driving import Budget, drive
from slamlab.project.scores import prepare
from slamlab.project.world_families import Family
from tests.project.students import CorrelativeGrid, Diverges, KeyframeIcp, WallHeading, Wheels

LOOP = Family("loop", plans=(("crrc", "crc"),))


@cache
def arena():
    """A small world, the same for all tests."""
    return prepare(draw_world(LOOP, np.random.default_rng(2), 25.0))


@cache
def result(make):
    """What an estimator makes of it."""
    return arena().judge(drive(make, arena().readings, Budget(*[np.inf] * 4)))


def test_scores_order_students_as_their_errors_do():
    makers = (Wheels, WallHeading, CorrelativeGrid, KeyframeIcp)
    by_error = sorted(makers, key=lambda make: -result(make).measures.gain)
    by_points = sorted(makers, key=lambda make: -result(make).points)
    assert by_points == by_error
    assert result(Wheels).points == 0
    assert result(WallHeading).points > 5
    assert result(KeyframeIcp).points > 40


def test_who_runs_off_scores_0_and_is_told_that_poses_are_not_finite():
    found = result(Diverges)
    assert found.points == 0
    assert any("poses are not finite" in mistake for mistake in found.mistakes)


def posing(value):
    """A step after which the pose is something else."""

    def step(self, reading):
        Wheels.step(self, reading)
        self.pose = value

    return step


def answering(**parts):
    """Wheels, but for one part that answers something else."""
    return type("MySlam", (Wheels,), parts)


@pytest.mark.parametrize(
    ("make", "told"),
    [
        (answering(step=posing([1, 2])), "pose has shape (2,), expected (3,)"),
        (answering(step=posing(None)), "pose is None after step"),
        (answering(step=posing("here")), "pose returned str"),
        (answering(trajectory=lambda self: None), "trajectory() returned None"),
        (answering(trajectory=lambda self: self.poses[:3]), "trajectory() has shape (3, 3)"),
        (answering(trajectory=lambda self: np.array(self.poses)[:, :2]), "trajectory() has shape"),
        (answering(trajectory=lambda self: 7), "trajectory() has shape ()"),
        (answering(map=lambda self: np.zeros((5, 3))), "map() has shape (5, 3), not (n, 2)"),
        (answering(map=lambda self: np.zeros(8)), "map() has shape (8,), not (n, 2)"),
        (answering(map=lambda self: 7), "map() has shape (), not (n, 2)"),
        (answering(map=lambda self: "walls"), "map() returned str"),
        (answering(map=lambda self: [[0, 1], [2]]), "map()"),
        (answering(map=lambda self: np.full((5, 2), np.nan)), "none of the 5 points"),
        (answering(covariance=np.eye(2)), "covariance has shape (2, 2)"),
        (answering(covariance=5), "covariance has shape ()"),
        (answering(covariance=np.triu(np.ones((3, 3)))), "covariance is not symmetric"),
        (answering(step=lambda self: None), "step failed with TypeError"),
    ],
)
def test_what_is_no_answer_is_told_by_its_name_and_its_shape(make, told):
    driven = drive(make, arena().readings[:6])
    assert any(told in mistake for mistake in driven.mistakes), driven.mistakes


def test_lists_whole_numbers_and_a_trajectory_without_a_map_are_as_good_as_arrays():
    listed = answering(
        pose=property(lambda self: list(map(int, self._x)), lambda self, x: setattr(self, "_x", x)),
        trajectory=lambda self: [list(pose) for pose in self.poses],
        map=lambda self: [[0, 1], [2, 3]],
    )
    driven = drive(listed, arena().readings[:6])
    assert not driven.mistakes
    assert driven.points.tolist() == [[0, 1], [2, 3]]
