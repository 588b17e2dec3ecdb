"""Preflight warns students about problems at grading before they submit."""

from classroom.grading import judge, preflight
from slamlab.cli import main
from tests.classroom.grading import fake
from tests.classroom.grading.conftest import notebook, workers


def checked(tmp_path, capsys, *cells):
    file = tmp_path / "anna.ipynb"
    file.write_text(notebook(*cells))
    code = main(["check", str(file)])
    return code, " ".join(capsys.readouterr().out.split())


def test_each_cell_that_fails_is_reported_with_its_remedy():
    messages = {
        "print(late)": "defined (line 1 of the cell). Cell 8 defines late, but grading runs cells",
        "print(deleted)": "No cell defines deleted. If you deleted its cell, copy it from a new",
        "import slamlab.geometry": "slamlab.geometry is not available at grading; this exercise "
        "may use slamlab.models.noise",
        "import nowhere": "copy code from your own files into the notebook",
        "open('gains.npy')": "write into the notebook what you need from the file",
        "exit()": "exit() does not exist; delete the call",
        "f(:": "SyntaxError: invalid syntax (line 1 of the cell)",
    }
    cells = list(enumerate([*messages, "late = 1"], 1))
    found = judge.judge_notebook(fake.EXERCISE, cells, b"seed", workers())["cells"]
    assert list(found) == list(range(1, 8))
    for problem, message in zip(found.values(), messages.values(), strict=True):
        assert message in problem


def test_equal_remedies_are_stated_once():
    problem = "FileNotFoundError: [Errno 2] No such file or directory: 'a' (line 1 of the cell)"
    found = preflight.explained({2: problem, 1: problem}, [], fake.EXERCISE)
    assert list(found) == [1, 2] and found[1].startswith(problem) and found[2] == problem


def test_missing_tasks_are_named_and_a_failure_is_reported_in_full(tmp_path, capsys):
    broken = "def turn(v, angle):\n    raise ValueError('angle must not be negative')"
    code, text = checked(tmp_path, capsys, fake.SOLUTION, "del double", broken)
    assert code == 1
    assert "double is not defined" in text
    assert "ValueError: angle must not be negative (line 2 of the cell, in turn)" in text


def test_a_slow_notebook_is_warned_of():
    assert preflight.form_warnings({}, 10.0) == []
    assert "grading stops" in preflight.form_warnings({}, 100.0)[0]
