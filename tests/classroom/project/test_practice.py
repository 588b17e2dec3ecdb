"""Practice in a notebook: runs end, report what went wrong, and limit their output."""

from contextlib import contextmanager

import numpy as np
import pytest

from classroom.exercises.function_calls import StudentError
from classroom.exercises.time_limit import TimeLimitExceeded
from classroom.project import practice
from classroom.project.estimator_runs import Budget
from classroom.project.practice import Trial, practise, table
from course.project.template import MySlam
from tests.classroom.project.test_point_scale import prepared_world


@pytest.fixture(autouse=True)
def small(monkeypatch):
    monkeypatch.setattr(
        practice, "practice_worlds", lambda family, worlds, seed: (prepared_world(),)
    )


def test_a_step_that_never_ends_is_ended_and_reported():
    class Endless(MySlam):
        def step(self, reading):
            while True:
                pass

    (trial,) = practise(Endless)
    (mistake,) = trial.result.mistakes
    assert mistake.startswith("at reading 1 of") and "step took 1." in mistake
    assert trial.result.points == 0


def test_a_worker_that_the_guard_ends_is_reported_whatever_the_clock():
    @contextmanager
    def strikes(seconds):
        raise TimeLimitExceeded
        yield

    budget = Budget(guard=strikes, clock=lambda: 0.0)
    with pytest.raises(StudentError, match=r"step took 1\.0 s of CPU"):
        budget.timed(lambda: None, 1.0, "step")


def test_printed_output_is_truncated(capsys):
    class Loud(MySlam):
        def step(self, reading):
            print("x" * 1000)
            super().step(reading)

    practise(Loud)
    output = capsys.readouterr().out
    assert output.startswith("Your code printed:\nxxx")
    assert "more characters" in output and len(output) < 1000


def test_one_family_needs_no_list():
    assert [trial.prepared_world for trial in practise(MySlam, "plain")] == [prepared_world()]


def test_a_table_has_a_column_for_each_number_however_large(monkeypatch):
    class Boasting(MySlam):
        covariance = 1e-12 * np.eye(3)

        def map(self):
            return np.empty((0, 2))

    (trial,) = practise(Boasting)
    head, row, *more = table([Trial(trial.prepared_world, trial.run, trial.result)]).splitlines()
    columns = ["points", "1 m", "5 m", "20 m", "map", "NEES", "CPU"]
    assert [name for name in columns if name not in head] == []
    assert len(row.split()) == 9  # the unit of the last stands apart
    assert more == ["    map() returns no points: the map's fifth of the score is lost"]
