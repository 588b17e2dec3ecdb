"""Preflight warns students about problems at grading before they submit."""

import pytest

from classroom.grading import preflight
from slamlab.cli import main
from tests.classroom.grading import fake
from tests.classroom.grading.conftest import notebook


def checked(tmp_path, capsys, *cells):
    file = tmp_path / "anna.ipynb"
    file.write_text(notebook(*cells))
    code = main(["check", str(file)])
    return code, " ".join(capsys.readouterr().out.split())


@pytest.mark.slow
@pytest.mark.parametrize(
    ("cells", "message"),
    [
        (["print(late)", "late = 1"], "Cell 2 defines late, but grading runs cells"),
        (["print(deleted)"], "No cell defines"),
        (["from slamlab.geometry import wrap"], "slamlab.geometry is not available at grading; "
         "this exercise may use slamlab.models.noise"),
        (["import nowhere"], "No module named 'nowhere'"),
    ],
)  # fmt: skip
def test_a_problem_of_form_is_reported_with_its_remedy(tmp_path, capsys, cells, message):
    code, text = checked(tmp_path, capsys, *cells, fake.SOLUTION)
    assert code == 0  # the tasks themselves are solved
    assert "cell 1 fails" in text
    assert message in text


def test_missing_tasks_are_named_and_a_failure_is_reported_in_full(tmp_path, capsys):
    broken = "def turn(v, angle):\n    raise ValueError('angle must not be negative')"
    code, text = checked(tmp_path, capsys, fake.SOLUTION, "del double", broken)
    assert code == 1
    assert "double is not defined" in text
    assert "ValueError: angle must not be negative (line 2 of the cell, in turn)" in text


def test_a_slow_notebook_is_warned_of():
    assert preflight.form_warnings([], {}, fake.EXERCISE, 10.0) == []
    assert "grading stops" in preflight.form_warnings([], {}, fake.EXERCISE, 100.0)[0]
