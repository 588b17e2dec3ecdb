"""Judging in the sandbox: as good as outside it for who is honest, and no use to who cheats."""

import threading
from functools import cache

import numpy as np
import pytest

from course.project.solution import MySlam as Solution
from slamlab.contest.sandbox_judging import PROJECT, drive_in_sandbox
from slamlab.exercises.drives.student_estimator import GraderFault
from slamlab.grading.import_closure import closure
from slamlab.grading.staging import worker_modules
from slamlab.grading.worker_pool import WorkerStartError
from slamlab.project.drawing import draw_world
from slamlab.project.driving import Budget, drive
from slamlab.project.scores import prepare
from slamlab.project.world_families import LANDMARKS, Family
from tests.contest import cheaters
from tests.grading.conftest import workers

LOOP = Family("loop", plans=(("crrc", "crc"),))
JUDGES = ("drawing", "hidden_worlds", "scores", "points", "drive_errors", "judging", "driving")


@cache
def arena():
    """A small world, the same for all tests."""
    return prepare(draw_world(LOOP, np.random.default_rng(3), 25.0))


def driven(cells, readings=None, budget=None, **more):
    """A drive in the sandbox; through the first 20 readings where none are given."""
    readings = arena().readings[:20] if readings is None else readings
    return drive_in_sandbox(cells, readings, workers().start, budget or Budget(), **more)


@pytest.mark.slow
def test_the_solution_drives_in_the_sandbox_as_it_does_outside():
    inside = driven([(1, cheaters.SOLUTION)], arena().readings)
    outside = drive(Solution, arena().readings, Budget(*[np.inf] * 4))
    assert not inside.mistakes
    for name in ("online", "covariances", "trajectory", "points"):
        # BLAS rounds as it likes with another number of threads
        np.testing.assert_allclose(getattr(inside, name), getattr(outside, name), 0, 1e-9)
    assert inside.seconds > 0


def test_landmarks_pass_the_pipe_too():
    world = draw_world(LANDMARKS, np.random.default_rng(0), 25.0)
    seen = [
        *cheaters.acting("self.seen = reading.observations.ids.tolist()"),
        (3, "MySlam.map = lambda self: [[i, 0.0] for i in self.seen]"),
    ]
    readings = tuple(world)[:8]
    found = driven(seen, readings)
    assert found.points[:, 0].tolist() == readings[4].observations.ids.tolist()


def test_a_worker_holds_what_is_allowed_and_nothing_that_draws_or_judges():
    held = set(worker_modules(PROJECT))
    assert held >= set(PROJECT.allows)
    assert not held & {f"slamlab.project.{name}" for name in JUDGES}
    answers = [name for name in held if name.startswith(PROJECT.answers)]
    assert not answers
    assert not held & (set(closure(["slamlab.project.scores"])) - set(closure(PROJECT.allows)) - {
        "slamlab.project", "slamlab.exercises.drives.student_estimator", "slamlab.exercises",
        "slamlab.exercises.drives", "slamlab.exercises.drives.arguments",
    })  # fmt: skip


@pytest.mark.parametrize("name", ["TRUTH_READER", "SEED_GUESSER", "LOOKS_AHEAD"])
def test_a_cheater_finds_nothing_and_gains_nothing(name):
    found = driven(getattr(cheaters, name), arena().readings)
    assert not found.mistakes
    assert arena().judge(found).points == 0


def test_nothing_is_carried_from_one_world_to_the_next():
    budget = Budget()
    for _ in range(2):
        assert not driven(cheaters.REMEMBERS, budget=budget).mistakes


@pytest.mark.slow
@pytest.mark.parametrize("name", cheaters.HARM)
def test_harm_ends_that_world_and_leaves_the_next_alone(name):
    budget = Budget()
    first = driven(cheaters.HARM[name], budget=budget)
    assert first.mistakes[0].startswith("at reading 5 of 20: ")
    assert first.completeness == 4 / 20
    assert not driven([(1, cheaters.TEMPLATE)], budget=budget).mistakes


def test_who_floods_loses_the_map_and_no_more():
    found = driven(cheaters.FLOODS)
    assert found.completeness == 1
    assert len(found.points) == 0
    assert "at most 500000 are allowed" in found.mistakes[0]


def test_who_hangs_is_ended(monkeypatch):
    shorter(monkeypatch, "step", 1.0)
    found = driven(cheaters.HANGS)
    assert "at reading 5 of 20" in found.mistakes[0]
    assert found.completeness == 4 / 20


def shorter(monkeypatch, request, seconds):
    """Wait less for an answer of the worker's."""
    from slamlab.contest import sandbox_judging as judging

    drives = dict(judging.DRIVES)
    drives[request] = type(drives[request])(drives[request].functions, drives[request].run, seconds)
    monkeypatch.setattr(judging, "DRIVES", drives)


def test_cpu_is_counted_by_the_kernel_whatever_the_clocks_of_a_worker_say():
    budget = Budget(total=1.5)
    found = driven(cheaters.LIES_ABOUT_TIME, budget=budget)
    assert "are used up" in found.mistakes[0]
    assert 1.5 < budget.spent < 3
    after = driven([(1, cheaters.TEMPLATE)], budget=budget)
    assert after.completeness == 0
    assert "are used up" in after.mistakes[0]


def test_who_sleeps_uses_up_the_patience_of_the_judge():
    budget = Budget(wall_clock=ticking(40.0))
    assert "does it wait or sleep" in driven(cheaters.SLEEPS, budget=budget).mistakes[0]


def ticking(step):
    """A clock that goes on by so much whenever it is looked at."""
    now = [0.0]

    def clock():
        now[0] += step
        return now[0]

    return clock


def test_a_notebook_without_the_class_is_told_which_cell_failed():
    found = driven([(1, "import nothing_of_that_name"), (4, "class MySlam(Missing): pass")])
    assert "MySlam is not defined" in found.mistakes[0]
    assert any(mistake.startswith("cell 4: NameError") for mistake in found.mistakes)
    assert found.completeness == 0


@pytest.mark.parametrize(
    ("cell", "is_told"),
    [
        ("from slamlab.project import practice\nclass MySlam(MySlam):\n    pass", True),
        ("unknown\ndef match():\n    pass", True),
        ("print(unknown)", False),
    ],
)
def test_a_cell_that_failed_and_left_the_class_before_it_is_told(cell, is_told):
    found = driven([(1, cheaters.TEMPLATE), (4, cell)], arena().readings[:3])
    assert np.isfinite(found.online).all()
    assert [mistake.startswith("cell 4: ") for mistake in found.mistakes] == [True] * is_told


def test_a_fault_of_the_graders_is_not_told_as_the_students():
    def none(exercise):
        raise WorkerStartError("no worker today")

    with pytest.raises(GraderFault, match="no worker today"):
        drive_in_sandbox([(1, cheaters.TEMPLATE)], arena().readings[:3], none, Budget())
    stop = threading.Event()
    stop.set()
    with pytest.raises(GraderFault, match="stopped"):
        driven([(1, cheaters.TEMPLATE)], stop=stop)
