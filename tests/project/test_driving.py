"""Driving: whatever a student's class does wrong ends that world, in a sentence, and no more."""

import types

import numpy as np
import pytest

from course.project.template import MySlam
from slamlab.project.driving import Budget, drive
from slamlab.readings import Reading

WORLD = [Reading(float(i), np.array([0.1, 0.0, 0.0])) for i in range(20)]


class Clock:
    """A virtual CPU clock."""

    now = 0.0

    def __call__(self):
        return self.now


def estimator(**parts):
    """A class that answers zeros, but for some parts."""
    told = {"pose": np.zeros(3), "step": lambda self, reading: None}
    return type("MySlam", (), told | parts)


def after(count, act):
    """A step that does nothing so many times, and then something."""

    def step(self, reading):
        self.count = getattr(self, "count", 0) + 1
        if self.count > count:
            act(self)

    return step


def divides_by_zero(self):
    raise ZeroDivisionError("division by zero")


def pose_of(value):
    return lambda self: setattr(self, "pose", value)


@pytest.mark.parametrize(
    ("make", "told"),
    [
        (estimator(step=after(5, divides_by_zero)), "step failed with ZeroDivisionError"),
        (estimator(step=after(5, pose_of(np.zeros(2)))), r"pose has shape \(2,\), expected \(3,\)"),
        (estimator(step=after(5, pose_of(None))), "pose is None after step"),
        (estimator(step=after(5, pose_of("lost"))), "pose returned str"),
        (estimator(step=after(5, pose_of(np.zeros(3) * 1j))), "complex"),
        (
            estimator(step=after(5, lambda self: setattr(self, "covariance", np.eye(2)))),
            r"covariance has shape \(2, 2\)",
        ),
        (
            estimator(step=after(5, lambda self: setattr(self, "covariance", np.tri(3)))),
            "not symmetric",
        ),
    ],
)
def test_a_mistake_ends_the_world_where_it_was_made_and_what_came_before_counts(make, told):
    driven = drive(make, WORLD)
    (mistake,) = driven.mistakes
    assert mistake.startswith("at reading 6 of 20: ")
    with pytest.raises(AssertionError, match=told):
        raise AssertionError(mistake)
    assert driven.completeness == 5 / 20


@pytest.mark.parametrize(
    ("make", "told"),
    [
        (lambda: divides_by_zero(None), "making the estimator failed with ZeroDivisionError"),
        (type("Empty", (), {}), "has no step"),
        (type("Blind", (), {"step": lambda self, reading: None}), "has no pose"),
        (
            estimator(__init__=lambda self: (_ for _ in ()).throw(NotImplementedError)),
            "not attempted yet",
        ),
    ],
)
def test_an_estimator_that_cannot_begin_has_no_poses(make, told):
    driven = drive(make, WORLD)
    assert told in driven.mistakes[0]
    assert driven.completeness == 0


@pytest.mark.parametrize(
    ("parts", "told"),
    [
        ({"trajectory": lambda self: np.zeros((7, 3))}, "trajectory() has shape (7, 3)"),
        ({"trajectory": divides_by_zero}, "trajectory failed with ZeroDivisionError"),
        ({"map": lambda self: np.zeros((4, 3))}, "map() has shape (4, 3), not (n, 2)"),
        ({"map": lambda self: np.zeros((60_000, 2))}, "60000 points"),
        ({"map": divides_by_zero}, "map failed with ZeroDivisionError"),
    ],
)
def test_what_fails_at_the_end_costs_only_itself(parts, told):
    driven = drive(estimator(**parts), WORLD)
    assert told in driven.mistakes[0]
    assert driven.completeness == 1
    assert len(driven.points) == 0


def test_poses_that_are_not_finite_are_told_and_missing():
    driven = drive(estimator(step=after(15, pose_of([np.nan, 0, np.inf]))), WORLD)
    assert driven.completeness == 15 / 20
    assert driven.mistakes[0].startswith(
        "5 of 20 poses are not finite, or farther away than 1000 km"
    )


@pytest.mark.parametrize("number", [1e7, -1e308, np.inf])
def test_numbers_beyond_any_building_count_as_not_finite(number):
    driven = drive(estimator(step=after(15, pose_of([number, 0, 0])),
                             map=lambda self: [[0, 1], [0, number]]), WORLD)  # fmt: skip
    assert driven.completeness == 15 / 20
    np.testing.assert_array_equal(driven.points, [[0, 1]])


def test_the_past_is_what_trajectory_says_at_the_end_not_the_poses_given_online():
    driven = drive(estimator(trajectory=lambda self: np.ones((20, 3))), WORLD)
    assert (driven.online == 0).all()
    assert (driven.trajectory == 1).all()


def test_a_trajectory_of_the_package_will_do_and_rows_of_a_map_that_are_not_finite_are_left_out():
    driven = drive(
        estimator(
            trajectory=lambda self: types.SimpleNamespace(poses=np.ones((20, 3))),
            map=lambda self: [[0, 1], [np.nan, 2]],
        ),
        WORLD,
    )
    assert (driven.trajectory == 1).all()
    np.testing.assert_array_equal(driven.points, [[0, 1]])


def test_a_step_that_takes_too_long_ends_the_world():
    clock = Clock()

    def burn(self):
        clock.now += 1.5

    driven = drive(estimator(step=after(3, burn)), WORLD, Budget(clock=clock))
    assert driven.mistakes[0].startswith("at reading 4 of 20: step took 1.5 s of CPU")
    assert driven.completeness == 3 / 20


def test_who_used_up_the_budget_drives_no_more_worlds():
    clock = Clock()

    def burn(self):
        clock.now += 0.9

    budget, make = Budget(total=30.0, clock=clock), estimator(step=after(0, burn))
    driven = [drive(make, WORLD, budget) for _ in range(4)]
    assert [d.completeness for d in driven] == [1.0, 13 / 20, 0, 0]
    assert all("are used up" in d.mistakes[0] for d in driven[1:])


def test_readings_come_one_at_a_time_nobody_looks_ahead():
    made = []

    class Stream:
        def __len__(self):
            return 5

        def __iter__(self):
            for i in range(5):
                made.append(i)
                yield WORLD[i]

    seen = estimator(step=lambda self, reading: seen_with.append((reading.time, len(made))))
    seen_with = []
    drive(seen, Stream())
    assert seen_with == [(float(i), i + 1) for i in range(5)]


def test_the_template_drives_and_adds_up_the_increments():
    driven = drive(MySlam, WORLD)
    assert not driven.mistakes
    np.testing.assert_allclose(driven.trajectory[:, 0], 0.1 * np.arange(1, 21))
    assert np.isnan(driven.covariances).all()
