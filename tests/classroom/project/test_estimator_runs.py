"""Driving: whatever a student's class does wrong ends that world, in a sentence, and no more."""

from types import SimpleNamespace

import numpy as np
import pytest

from classroom.project.estimator_runs import Budget, run_estimator
from course.project.template import MySlam
from slamlab.readings import Reading

WORLD = [Reading(float(i), np.array([0.1, 0.0, 0.0])) for i in range(20)]


class Clock:
    """A virtual CPU clock."""

    now = 0.0

    def __call__(self):
        return self.now


def estimator(**parts):
    """A class that answers zeros, but for some parts."""
    reported = {"pose": np.zeros(3), "step": lambda self, reading: None}
    return type("MySlam", (), reported | parts)


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


def covariance_of(value):
    return lambda self: setattr(self, "covariance", value)


@pytest.mark.parametrize(
    ("act", "message"),
    [
        (divides_by_zero, "step failed with ZeroDivisionError"),
        (pose_of(np.zeros(2)), "pose has shape (2,), expected (3,)"),
        (pose_of(None), "pose is None after step"),
        (pose_of("lost"), "pose returned str"),
        (pose_of(np.zeros(3) * 1j), "complex"),
        (covariance_of(np.eye(2)), "covariance has shape (2, 2)"),
        (covariance_of(5), "covariance has shape ()"),
        (covariance_of(np.tri(3)), "covariance is not symmetric"),
    ],
)
def test_a_mistake_ends_the_world_where_it_was_made_and_what_came_before_counts(act, message):
    run = run_estimator(estimator(step=after(5, act)), WORLD)
    (mistake,) = run.mistakes
    assert mistake.startswith("at reading 6 of 20: ") and message in mistake
    assert run.completeness == 5 / 20


def not_attempted(self):
    raise NotImplementedError


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: divides_by_zero(None), "creating the estimator failed with ZeroDivisionError"),
        (type("Empty", (), {}), "has no step"),
        (type("Blind", (), {"step": lambda self, reading: None}), "has no pose"),
        (estimator(__init__=not_attempted), "not attempted yet"),
        (estimator(step=lambda self: None), "step failed with TypeError"),
    ],
)
def test_an_estimator_that_cannot_begin_has_no_poses(make, message):
    run = run_estimator(make, WORLD)
    assert message in run.mistakes[0]
    assert run.completeness == 0


@pytest.mark.parametrize(
    ("part", "value", "message"),
    [
        ("trajectory", np.zeros((7, 3)), "trajectory() has shape (7, 3)"),
        ("trajectory", 7, "trajectory() has shape ()"),
        ("trajectory", None, "trajectory() returned None"),
        ("trajectory", ZeroDivisionError, "trajectory failed with ZeroDivisionError"),
        ("map", np.zeros((4, 3)), "map() has shape (4, 3), not (n, 2)"),
        ("map", np.zeros(8), "map() has shape (8,), not (n, 2)"),
        ("map", "walls", "map() returned str"),
        ("map", [[0, 1], [2]], "map()"),
        ("map", np.full((5, 2), np.nan), "none of the 5 points"),
        ("map", np.zeros((60_000, 2)), "60000 points"),
        ("map", ZeroDivisionError, "map failed with ZeroDivisionError"),
    ],
)
def test_a_failure_at_the_end_costs_only_itself(part, value, message):
    def answer(self):
        return divides_by_zero(self) if value is ZeroDivisionError else value

    run = run_estimator(estimator(**{part: answer}), WORLD)
    assert message in run.mistakes[0]
    assert run.completeness == 1
    assert len(run.points) == 0


def test_poses_that_are_not_finite_are_reported_and_missing():
    run = run_estimator(estimator(step=after(15, pose_of([np.nan, 0, np.inf]))), WORLD)
    assert run.completeness == 15 / 20
    assert run.mistakes[0].startswith("5 of 20 poses are not finite or are farther away than 1000")


@pytest.mark.parametrize("number", [1e7, -1e308, np.nan, np.inf])
def test_numbers_beyond_any_building_count_as_not_finite(number):
    make = estimator(
        step=after(15, pose_of([number, 0, 0])), map=lambda self: [[0, 1], [0, number]]
    )
    run = run_estimator(make, WORLD)
    assert run.completeness == 15 / 20
    np.testing.assert_array_equal(run.points, [[0, 1]])


@pytest.mark.parametrize(
    "kind", [np.array, lambda a: a.tolist(), lambda a: SimpleNamespace(poses=a)]
)
def test_the_final_trajectory_replaces_the_online_poses_whatever_holds_it(kind):
    make = estimator(trajectory=lambda self: kind(np.ones((20, 3))), pose=[0, 0, 0])
    run = run_estimator(make, WORLD)
    assert not run.mistakes
    assert (run.online == 0).all()
    assert (run.trajectory == 1).all()


def burning(seconds, at):
    """An estimator that takes CPU at each step after some, and the clock."""
    clock = Clock()

    def burn(self):
        clock.now += seconds

    return estimator(step=after(at, burn)), clock


def test_a_step_that_takes_too_long_ends_the_world():
    make, clock = burning(1.5, 3)
    run = run_estimator(make, WORLD, Budget(clock=clock))
    assert run.mistakes[0].startswith("at reading 4 of 20: step took 1.5 s of CPU")
    assert run.completeness == 3 / 20


def test_an_estimator_without_budget_runs_no_more_worlds():
    make, clock = burning(0.9, 0)
    budget = Budget(total=30.0, clock=clock)
    run = [run_estimator(make, WORLD, budget) for _ in range(4)]
    assert [d.completeness for d in run] == [1.0, 13 / 20, 0, 0]
    assert all("are used up" in d.mistakes[0] for d in run[1:])


def test_readings_are_passed_one_at_a_time_without_look_ahead():
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
    run_estimator(seen, Stream())
    assert seen_with == [(float(i), i + 1) for i in range(5)]


def test_the_template_runs_and_sums_the_increments():
    run = run_estimator(MySlam, WORLD)
    assert not run.mistakes
    np.testing.assert_allclose(run.trajectory[:, 0], 0.1 * np.arange(1, 21))
    assert np.isnan(run.covariances).all()
