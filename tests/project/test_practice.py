"""Practice in a notebook: what is tried there ends, says what went wrong, and floods nothing."""

from contextlib import contextmanager

import numpy as np
import pytest

from course.project.template import MySlam
from slamlab.exercises.drives import StudentError
from slamlab.exercises.time_limit import TimeLimitExceeded
from slamlab.project import practice
from slamlab.project.driving import Budget
from slamlab.project.practice import Trial, practise, table
from tests.project.test_points import arena


@pytest.fixture(autouse=True)
def small(monkeypatch):
    monkeypatch.setattr(practice, "practice_arenas", lambda family, worlds, seed: (arena(),))


def test_a_step_that_never_ends_is_ended_and_told():
    class Endless(MySlam):
        def step(self, reading):
            while True:
                pass

    (trial,) = practise(Endless)
    (mistake,) = trial.result.mistakes
    assert mistake.startswith("at reading 1 of") and "step took 1." in mistake
    assert trial.result.points == 0


def test_what_the_guard_ends_is_told_whatever_the_clock_says():
    @contextmanager
    def strikes(seconds):
        raise TimeLimitExceeded
        yield

    budget = Budget(guard=strikes, clock=lambda: 0.0)
    with pytest.raises(StudentError, match=r"step took 1\.0 s of CPU"):
        budget.timed(lambda: None, 1.0, "step")


def test_what_is_printed_is_cut(capsys):
    class Loud(MySlam):
        def step(self, reading):
            print("x" * 1000)
            super().step(reading)

    practise(Loud)
    said = capsys.readouterr().out
    assert said.startswith("your code printed:\nxxx")
    assert "characters more" in said and len(said) < 1000


def test_one_family_needs_no_list():
    assert [trial.arena for trial in practise(MySlam, "plain")] == [arena()]


def test_a_table_has_a_column_for_each_number_however_large(monkeypatch):
    class Boasting(MySlam):
        covariance = 1e-12 * np.eye(3)

        def map(self):
            return np.empty((0, 2))

    (trial,) = practise(Boasting)
    head, row, *more = table([Trial(trial.arena, trial.drive, trial.result)]).splitlines()
    columns = ["points", "1 m", "5 m", "20 m", "map", "NEES", "CPU"]
    assert [name for name in columns if name not in head] == []
    assert len(row.split()) == 9  # the unit of the last stands apart
    assert more == ["    map() gives no points: its fifth of the score is lost"]
