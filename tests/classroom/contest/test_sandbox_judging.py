"""Judging in the sandbox: the same result as outside it, and no advantage for cheaters."""

import threading
from functools import cache
from unittest.mock import Mock

import numpy as np
import pytest

from classroom.contest.sandbox_judging import project, run_in_sandbox
from classroom.exercises.function_calls.student_estimator import GraderFault
from classroom.grading.import_closure import closure
from classroom.grading.staging import worker_modules
from classroom.grading.worker_pool import WorkerStartError
from classroom.project.estimator_runs import Budget, run_estimator
from classroom.project.scores import prepare
from classroom.project.world_generation import generate_world
from classroom.project.world_parameters import LANDMARKS, WorldFamily
from course.project.solution import MySlam as Solution
from tests.classroom.contest import cheaters
from tests.classroom.grading.conftest import workers

LOOP = WorldFamily("loop", plans=(("crrc", "crc"),))
JUDGES = "world_generation hidden_worlds scores point_scale estimate_errors estimator_runs"


@cache
def prepared_world():
    """A small world, the same for all tests."""
    return prepare(generate_world(LOOP, np.random.default_rng(3), 25.0))


def run_cells(cells, readings=None, budget=None, **more):
    """A drive in the sandbox; through the first 20 readings where none are given."""
    readings = prepared_world().readings[:20] if readings is None else readings
    return run_in_sandbox(cells, readings, workers().start, budget or Budget(), **more)


@pytest.mark.slow
def test_the_solution_runs_in_the_sandbox_as_it_does_outside():
    inside = run_cells([(1, cheaters.SOLUTION)], prepared_world().readings)
    outside = run_estimator(Solution, prepared_world().readings, Budget(*[np.inf] * 4))
    assert not inside.mistakes
    for name in ("online", "covariances", "trajectory", "points"):
        # BLAS rounds as it likes with another number of threads
        np.testing.assert_allclose(getattr(inside, name), getattr(outside, name), 0, 1e-9)
    assert inside.seconds > 0


def test_landmarks_pass_the_pipe_too():
    world = generate_world(LANDMARKS, np.random.default_rng(0), 25.0)
    seen = cheaters.acting("self.seen = reading.observations.ids.tolist()")
    readings, cell = tuple(world)[:8], "MySlam.map = lambda self: [[i, 0.0] for i in self.seen]"
    found = run_cells([*seen, (3, cell)], readings)
    assert found.points[:, 0].tolist() == readings[4].observations.ids.tolist()


def test_a_worker_holds_what_is_allowed_and_nothing_that_draws_or_judges():
    held = set(worker_modules(project()))
    assert held >= set(project().allows)
    assert not held & {f"classroom.project.{name}" for name in JUDGES.split()}
    answers = [name for name in held if name.startswith(project().answers)]
    assert not answers
    judges = set(closure(["classroom.project.scores"])) - set(closure(project().allows))
    calls = "classroom.exercises.function_calls"
    allowed = {"classroom", "classroom.project", "classroom.exercises", calls}
    allowed |= {f"{calls}.changed_arguments", f"{calls}.student_estimator"}
    assert not held & (judges - allowed)


@pytest.mark.parametrize("name", ["TRUTH_READER", "SEED_GUESSER", "LOOKS_AHEAD"])
def test_a_cheater_finds_nothing_and_gains_nothing(name):
    found = run_cells(getattr(cheaters, name), prepared_world().readings)
    assert not found.mistakes
    assert prepared_world().judge(found).points == 0


def test_nothing_is_carried_from_one_world_to_the_next():
    budget = Budget()
    for _ in range(2):
        assert not run_cells(cheaters.REMEMBERS, budget=budget).mistakes


@pytest.mark.slow
@pytest.mark.parametrize("name", cheaters.HARM)
def test_harm_ends_that_world_and_leaves_the_next_alone(name):
    budget = Budget()
    first = run_cells(cheaters.HARM[name], budget=budget)
    assert first.mistakes[0].startswith("at reading 5 of 20: ")
    assert first.completeness == 4 / 20
    assert not run_cells([(1, cheaters.TEMPLATE)], budget=budget).mistakes


def test_an_estimator_that_floods_loses_the_map_and_no_more():
    found = run_cells(cheaters.FLOODS)
    assert found.completeness == 1
    assert len(found.points) == 0
    assert "at most 500000 are allowed" in found.mistakes[0]


def test_an_estimator_that_hangs_is_ended(monkeypatch):
    shorter(monkeypatch, "step", 1.0)
    found = run_cells(cheaters.HANGS)
    assert "at reading 5 of 20" in found.mistakes[0]
    assert found.completeness == 4 / 20


def shorter(monkeypatch, request, seconds):
    """Wait less for an answer of the worker's."""
    from classroom.contest import sandbox_judging as judging

    calls = dict(judging.CALLS)
    calls[request] = type(calls[request])(calls[request].functions, calls[request].run, seconds)
    monkeypatch.setattr(judging, "CALLS", calls)


def test_cpu_is_counted_by_the_kernel_whatever_the_clocks_of_a_worker_show():
    budget = Budget(total=1.5)
    found = run_cells(cheaters.LIES_ABOUT_TIME, budget=budget)
    assert "are used up" in found.mistakes[0]
    assert 1.5 < budget.spent < 3
    after = run_cells([(1, cheaters.TEMPLATE)], budget=budget)
    assert after.completeness == 0
    assert "are used up" in after.mistakes[0]


def test_an_estimator_that_sleeps_exhausts_the_time_limit_of_the_judge():
    budget = Budget(wall_clock=ticking(40.0))
    mistakes = run_cells(cheaters.SLEEPS, budget=budget).mistakes
    assert "does the estimator wait or sleep" in mistakes[0]


def ticking(step):
    """A clock that goes on by so much whenever it is looked at."""
    now = [0.0]

    def clock():
        now[0] += step
        return now[0]

    return clock


def test_for_a_notebook_without_the_class_the_failed_cell_is_reported():
    found = run_cells([(1, "import nothing_of_that_name"), (4, "class MySlam(Missing): pass")])
    assert "MySlam is not defined" in found.mistakes[0]
    assert any(mistake.startswith("cell 4: NameError") for mistake in found.mistakes)
    assert found.completeness == 0


@pytest.mark.parametrize(
    ("cell", "is_reported"),
    [
        ("from classroom.project import practice\nclass MySlam(MySlam):\n    pass", True),
        ("unknown\ndef match():\n    pass", True),
        ("print(unknown)", False),
    ],
)
def test_a_cell_that_failed_and_left_the_class_before_it_is_reported(cell, is_reported):
    found = run_cells([(1, cheaters.TEMPLATE), (4, cell)], prepared_world().readings[:3])
    assert np.isfinite(found.online).all()
    assert [mistake.startswith("cell 4: ") for mistake in found.mistakes] == [True] * is_reported


def test_a_grader_fault_is_not_reported_as_the_students():
    none = Mock(side_effect=WorkerStartError("no worker today"))
    with pytest.raises(GraderFault, match="no worker today"):
        run_in_sandbox([(1, cheaters.TEMPLATE)], prepared_world().readings[:3], none, Budget())
    stop = threading.Event()
    stop.set()
    with pytest.raises(GraderFault, match="stopped"):
        run_cells([(1, cheaters.TEMPLATE)], stop=stop)
