"""Milestones of the project: a good SLAM passes, what lacks one thing fails and is told which."""

import numpy as np
import pytest

from course.project.bank import ScanGraph
from course.project.solution import MySlam as Solution
from course.project.template import MySlam as Template
from slamlab.exercises.drives.ex16 import by_wheels
from slamlab.exercises.drives.input_sets import MAIN
from slamlab.exercises.run_task import run
from slamlab.exercises.task import OPEN_SEED
from slamlab.exercises.tasks.ex16 import EXERCISE, short_drives

SEEDS = [OPEN_SEED, b"one", b"two"]
CORRIDOR, LOOP, SURE = EXERCISE.tasks


def verdict(task, make, seed=OPEN_SEED):
    return run(task, {"MySlam": make}, task.draw(seed))


def failed(found):
    return {law.name for law in found.laws if law.failed}


class WithoutLoops(Solution):
    """Matches scans, and never looks for a loop."""

    def _close_loop(self, j):
        return False


class OfThen(Solution):
    """Closes loops, and tells its poses as they were believed when they were given."""

    def __init__(self):
        super().__init__()
        self._online = []

    def step(self, reading):
        super().step(reading)
        self._online.append(self.pose)

    def trajectory(self):
        return np.array(self._online)


class Mirrored(Template):
    """Takes every turn the other way round."""

    def step(self, reading):
        reading.odometry[2] *= -1
        super().step(reading)


class Still(Template):
    """Takes each increment for a pose."""

    def trajectory(self):
        return 0.1 * super().trajectory()


def claiming(claim, of=Solution):
    """An estimator with another covariance."""

    class Claiming(of):
        def step(self, reading):
            super().step(reading)
            self.covariance = claim

    return Claiming


@pytest.mark.parametrize("task", EXERCISE.tasks, ids=lambda task: task.id)
@pytest.mark.parametrize("seed", SEEDS)
def test_the_solution_passes_and_the_template_has_not_attempted(task, seed):
    assert verdict(task, Solution, seed).full
    found = verdict(task, Template, seed)
    assert (found.points, found.kind) == (0, "not attempted")


@pytest.mark.parametrize("task", [CORRIDOR, LOOP], ids=lambda task: task.id)
def test_another_good_estimator_passes(task):
    assert verdict(task, ScanGraph).full


@pytest.mark.parametrize("seed", SEEDS)
def test_who_is_sure_of_what_the_wheels_tell_has_not_attempted_it(seed):
    class OfWheels(Template):
        count = 0

        def step(self, reading):
            super().step(reading)
            self.count += 1
            self.covariance = np.diag([0.05, 0.05, 0.02]) ** 2 * self.count**2 + 1e-6 * np.eye(3)

    found = verdict(SURE, OfWheels, seed)
    assert (found.points, found.kind) == (0, "not attempted")
    assert SURE.needs == (CORRIDOR.id,)


def test_the_trajectory_is_judged_before_a_map_that_hangs_on_it():
    class Nowhere(Solution):
        def trajectory(self):
            return np.full_like(super().trajectory(), np.nan)

        def map(self):
            return np.full((9, 2), np.nan)

    assert "map" not in verdict(CORRIDOR, Nowhere).problem


@pytest.mark.parametrize("seed", SEEDS)
def test_who_closes_no_loop_survives_the_corridor_only(seed):
    assert verdict(CORRIDOR, WithoutLoops, seed).full
    found = verdict(LOOP, WithoutLoops, seed)
    assert failed(found) == {"met", "carried"}
    assert found.diagnosis == "not-closed"


def test_who_tells_the_poses_of_then_is_told_so():
    found = verdict(LOOP, OfThen)
    assert failed(found) == {"carried"}
    assert found.diagnosis == "last-only"


@pytest.mark.parametrize(("make", "name"), [(Mirrored, "worse"), (Still, "stays")])
def test_who_is_worse_than_the_wheels_is_told_so(make, name):
    found = verdict(CORRIDOR, make)
    assert (found.points, found.diagnosis) == (0, name)


def test_a_map_may_be_to_come_but_is_no_list_of_numbers():
    def mapping(answer):
        return type("Mapping", (Solution,), {"map": lambda self: answer()})

    def to_come():
        raise NotImplementedError

    found = verdict(CORRIDOR, mapping(lambda: np.zeros(7)))
    assert (found.points, found.kind) == (0, "malformed")
    assert "map() has shape (7,), not (n, 2)" in found.problem
    assert verdict(CORRIDOR, mapping(to_come)).full
    assert verdict(CORRIDOR, mapping(lambda: None)).full


@pytest.mark.parametrize(
    ("claim", "laws", "name"),
    [
        (1e-9 * np.eye(3), {"grows", "honest"}, "too-sure"),
        (1e3 * np.eye(3), {"grows", "honest"}, "too-modest"),
        (np.diag([0.003, 0.003, 0.0005]), {"grows"}, "constant"),
        (-np.eye(3), {"grows", "honest"}, "no-covariance"),
    ],
)
def test_a_false_claim_fails_and_is_told(claim, laws, name):
    found = verdict(SURE, claiming(claim))
    assert failed(found) == laws
    assert found.diagnosis == name


def test_who_only_grows_earns_nothing():
    class Growing(Solution):
        count = 0

        def step(self, reading):
            super().step(reading)
            self.count += 1
            self.covariance = 1e-9 * self.count**4 * np.eye(3)

    assert verdict(SURE, Growing).points == 0


@pytest.mark.parametrize("task", EXERCISE.tasks, ids=lambda task: task.id)
def test_the_truth_is_in_no_array_and_the_wheels_are_far_from_it(task):
    inputs = task.draw(OPEN_SEED)[MAIN]
    truth = short_drives.route(inputs)
    assert set(inputs) == {"odometry", "ranges"}
    for odometry in inputs["odometry"]:
        assert np.hypot(*(by_wheels(odometry) - truth)[-5:, :2].T).mean() > 0.4


def test_every_law_asks_a_question_and_what_is_missing_is_named():
    assert all(law.asks for task in EXERCISE.tasks for law in task.laws)
    found = run(CORRIDOR, {}, CORRIDOR.draw(OPEN_SEED))
    assert (found.kind, found.problem) == ("missing", "MySlam is not defined")
