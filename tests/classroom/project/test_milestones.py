"""Milestones of the project: a good SLAM passes, one with a fault fails with its milestone."""

import numpy as np
import pytest

from classroom.exercises.function_calls.run_and_pack import MAIN
from classroom.exercises.run_task import run
from classroom.exercises.task import OPEN_SEED
from course.exercises.ex16_your_own_slam import short_runs
from course.exercises.ex16_your_own_slam.calls import odometry_poses
from course.exercises.ex16_your_own_slam.exercise import EXERCISE
from course.exercises.ex16_your_own_slam.sure.task import BLIND, HIGHS, is_consistent, mean_nees
from course.project.reference_estimators import ScanGraph
from course.project.solution import MySlam as Solution
from course.project.template import MySlam as Template
from slamlab.geometry import compose, transform

SEEDS = [OPEN_SEED, b"one", b"two"]
CORRIDOR, LOOP, SURE = MILESTONES = EXERCISE.tasks[:3]


def verdict(task, make, seed=OPEN_SEED):
    return run(task, {"MySlam": make}, task.draw_inputs(seed))


def failed(found):
    return {law.name for law in found.laws if law.failed}


class WithoutLoops(Solution):
    """Matches scans, and never looks for a loop."""

    def _close_loop(self, j):
        return False


class OfThen(Solution):
    """Closes loops, and returns its poses as they were estimated online."""

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


class Turned(Solution):
    """Reports the poses and the covariance of the solution in a frame turned by 90°."""

    FRAME = np.array([3.0, -2.0, np.pi / 2])

    def __init__(self):
        super().__init__()
        self._own = Solution()

    def step(self, reading):
        self._own.step(reading)
        turn = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])
        self.pose = compose(self.FRAME, self._own.pose)
        self.covariance = turn @ self._own.covariance @ turn.T

    def trajectory(self):
        return compose(self.FRAME, self._own.trajectory())

    def map(self):
        return transform(self.FRAME, self._own.map())


def claiming(claim, of=Solution):
    """An estimator that reports another covariance, a function of its own."""

    class Claiming(of):
        def step(self, reading):
            self.covariance = getattr(self, "own", np.zeros((3, 3)))
            super().step(reading)
            self.own, self.covariance = self.covariance, claim(self.covariance)

    return Claiming


@pytest.mark.parametrize("task", MILESTONES, ids=lambda task: task.id)
@pytest.mark.parametrize("seed", SEEDS)
def test_the_solution_passes_and_the_template_has_not_attempted(task, seed):
    assert verdict(task, Solution, seed).full
    found = verdict(task, Template, seed)
    assert (found.points, found.kind) == (0, "not attempted")


@pytest.mark.parametrize("task", [CORRIDOR, LOOP], ids=lambda task: task.id)
def test_another_good_estimator_passes(task):
    assert verdict(task, ScanGraph).full


@pytest.mark.parametrize("seed", SEEDS)
def test_an_answer_without_uncertainty_of_odometry_is_no_attempt(seed):
    class OfWheels(Template):
        count = 0

        def step(self, reading):
            super().step(reading)
            self.count += 1
            self.covariance = np.diag([0.05, 0.05, 0.02]) ** 2 * self.count**2 + 1e-6 * np.eye(3)

    found = verdict(SURE, OfWheels, seed)
    assert (found.points, found.kind) == (0, "not attempted")


def test_the_trajectory_is_judged_before_the_map_that_depends_on_it():
    class Nowhere(Solution):
        def trajectory(self):
            return np.full_like(super().trajectory(), np.nan)

        def map(self):
            return np.full((9, 2), np.nan)

    assert "map" not in verdict(CORRIDOR, Nowhere).problem


@pytest.mark.parametrize("seed", SEEDS)
def test_an_estimator_without_loop_closure_survives_the_corridor_only(seed):
    assert verdict(CORRIDOR, WithoutLoops, seed).full
    found = verdict(LOOP, WithoutLoops, seed)
    assert failed(found) == {"met", "carried"}
    assert found.diagnosis == "not-closed"


def test_a_trajectory_of_online_poses_is_reported():
    found = verdict(LOOP, OfThen)
    assert failed(found) == {"carried"}
    assert found.diagnosis == "last-only"


@pytest.mark.parametrize(("make", "name"), [(Mirrored, "worse"), (Still, "stays")])
def test_an_estimator_worse_than_odometry_is_reported(make, name):
    found = verdict(CORRIDOR, make)
    assert (found.points, found.diagnosis) == (0, name)


def test_a_map_may_be_not_attempted_but_is_not_a_list_of_numbers():
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
        (lambda own: np.diag([0.01, 0.08, 0.003]), {"grows", "honest"}, "constant"),
        (lambda own: 1e-3 * own, {"honest"}, "too-sure"),
        (lambda own: 1e3 * own, {"honest"}, "too-modest"),
        (lambda own: -own, {"grows", "honest"}, "no-covariance"),
    ],
)
def test_an_inconsistent_covariance_fails_and_is_reported(claim, laws, name):
    found = verdict(SURE, claiming(claim))
    assert failed(found) == laws
    assert found.diagnosis == name


@pytest.mark.parametrize("seed", SEEDS)
def test_no_covariance_that_is_constant_or_ignores_the_scans_is_consistent(seed):
    inputs = SURE.draw_inputs(seed)[MAIN]
    found = SURE.call.run({"MySlam": Solution}, inputs)
    k = 1e-3 + np.arange(found["pose"].shape[1])[:, None, None]
    constant, growing = np.diag([0.031, 2, 0.4]) ** 2, 1.8e-3 * k**2 * np.eye(3)
    levels = np.where((k > BLIND[0]) & (k < BLIND[-1] + 1), np.diag([0.09, 2, 0.09]) ** 2, constant)
    for claimed in (constant, growing, levels):
        P = np.broadcast_to(claimed, found["covariance"].shape)
        assert not is_consistent(inputs, found | {"covariance": P})
    assert (mean_nees(inputs, found | {"covariance": P * 0 + growing}) < HIGHS).all()


@pytest.mark.parametrize(
    "seed", [OPEN_SEED, *(pytest.param(seed, marks=pytest.mark.slow) for seed in SEEDS[1:])]
)
def test_the_consistency_does_not_depend_on_the_frame(seed):
    sets = SURE.draw_inputs(seed)
    own, turned = (
        mean_nees(sets[MAIN], SURE.call.run({"MySlam": make}, sets[MAIN]))
        for make in (Solution, Turned)
    )
    assert turned == pytest.approx(own)
    assert verdict(SURE, Turned, seed).full


def test_a_covariance_that_only_grows_earns_nothing():
    class Growing(Solution):
        count = 0

        def step(self, reading):
            super().step(reading)
            self.count += 1
            self.covariance = 1e-9 * self.count**4 * np.eye(3)

    assert verdict(SURE, Growing).points == 0


@pytest.mark.parametrize("task", MILESTONES, ids=lambda task: task.id)
def test_no_array_contains_the_truth_and_odometry_is_far_from_it(task):
    inputs = task.draw_inputs(OPEN_SEED)[MAIN]
    truth = short_runs.route(inputs)
    assert set(inputs) == {"odometry", "ranges"}
    wheels = np.array(odometry_poses(inputs))
    assert np.hypot(*(wheels - truth)[:, -5:, :2].T).mean() > 0.4


def test_every_law_asks_a_question_and_what_is_missing_is_named():
    assert all(law.asks for task in EXERCISE.tasks for law in task.laws)
    found = run(CORRIDOR, {}, CORRIDOR.draw_inputs(OPEN_SEED))
    assert (found.kind, found.problem) == ("missing", "MySlam is not defined")
