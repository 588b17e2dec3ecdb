"""A student's notebook says of itself, as saved, what the grader will say of it."""

import os
from datetime import datetime

import pytest

from slamlab.checks import validate
from tests.grading import fake
from tests.grading.conftest import notebook
from tests.grading.test_judge import judged

CELL = "from slamlab.checks import validate\nvalidate()"


@pytest.fixture
def file(tmp_path, monkeypatch):
    """A saved notebook, and a kernel that was started for it."""
    path = tmp_path / "99 fake.ipynb"
    path.write_text(notebook(fake.SOLUTION, CELL), "utf-8")
    monkeypatch.setenv("JPY_SESSION_NAME", str(path))
    return path


def said(capsys, **names):
    exec(CELL, names)
    return capsys.readouterr().out


def test_the_file_is_judged_and_not_what_the_kernel_holds(file, capsys):
    text = said(capsys, double=None)
    assert text.startswith("99 fake.ipynb as saved at ")
    assert "✓ 99-turn · Turn a vector: 2.5 of 2.5 points" in text
    assert text.endswith("8 of 8 points\n")


def test_a_cell_that_runs_only_in_a_stale_order_is_told(file, capsys):
    file.write_text(notebook("print(late)", "late = 1", fake.SOLUTION, CELL), "utf-8")
    assert "Cell 2 defines late" in " ".join(said(capsys).split())


def test_the_file_may_be_named_from_elsewhere_or_by_another_program(file, monkeypatch, capsys):
    monkeypatch.chdir(file.parent)
    monkeypatch.setenv("JPY_SESSION_NAME", f"some/folder/{file.name}")
    assert "8 of 8 points" in said(capsys)
    monkeypatch.delenv("JPY_SESSION_NAME")
    assert "8 of 8 points" in said(capsys, __vsc_ipynb_file__=str(file))


@pytest.mark.parametrize("name", [None, "", "renamed.ipynb", "/nowhere/at all.ipynb", "console-1"])
def test_where_no_file_is_known_it_says_to_save(name, file, monkeypatch, capsys):
    monkeypatch.delenv("JPY_SESSION_NAME")
    if name is not None:
        monkeypatch.setenv("JPY_SESSION_NAME", name)
    text = said(capsys)
    assert "save it" in text
    assert "slamlab check" in text


@pytest.mark.parametrize("text", ["", "{", "[1]"])
def test_a_file_that_cannot_be_judged_is_told_in_a_line(text, file, capsys):
    file.write_text(text, "utf-8")
    assert said(capsys).splitlines()[-1].startswith(f"✗ {file}: ")


def test_under_nbgrader_and_in_a_worker_it_does_nothing(file, monkeypatch, capsys):
    graded = judged(fake.SOLUTION, CELL)
    assert graded["cells"] == {}
    assert all(verdict.full for verdict in graded["verdicts"])
    monkeypatch.setitem(os.environ, "NBGRADER_EXECUTION", "autograde")
    assert validate() is None
    assert capsys.readouterr().out == ""


def test_where_no_program_tells_the_file_it_is_known_by_the_cells_that_ran(
    file, monkeypatch, capsys
):
    monkeypatch.delenv("JPY_SESSION_NAME")
    monkeypatch.chdir(file.parent)
    (file.parent / "other.ipynb").write_text(notebook("import math", "x = 1", CELL), "utf-8")
    (file.parent / "broken.ipynb").write_text("{", "utf-8")
    text = said(capsys, In=["", fake.SOLUTION, CELL])
    assert text.startswith("99 fake.ipynb as saved at ")
    assert "save it" in said(capsys, In=["", "import math"])


def test_after_a_new_name_no_other_file_is_taken_for_it(file, capsys):
    """The kernel keeps the old name: nothing may bear it now, or what was handed out again."""
    ran = ["", fake.SOLUTION, CELL]
    (file.parent / "an older copy.ipynb").write_text(file.read_text("utf-8"), "utf-8")
    assert said(capsys, In=ran).startswith("99 fake.ipynb as saved")
    file.rename(file.parent / "new name.ipynb")
    assert "If it has a new name, restart its kernel" in said(capsys, In=ran)
    file.write_text(notebook("def double(a):\n    raise NotImplementedError", CELL), "utf-8")
    assert "If it has a new name, restart its kernel" in said(capsys, In=ran)


def test_of_all_that_was_run_just_what_differs_from_the_file_is_named(file, capsys):
    two = "def f():\n    return 1\n\nclass Mine:\n    step = f"
    trial = "@attempt\ndef _():\n    print({})"
    sources = [two, trial.format(1), trial.format(2), fake.SOLUTION, CELL]
    file.write_text(notebook(*sources), "utf-8")
    again = ["", two + "  # as before", trial.format(1), trial.format(2), trial.format(1)]
    assert "not saved" not in said(capsys, In=[*again, fake.SOLUTION, CELL])
    changed = two.replace("step = f", "step = None")
    told = [line for line in said(capsys, In=[*again, changed]).splitlines() if "not saved" in line]
    assert [line.split()[2] for line in told] == ["Mine"]


def test_a_file_that_was_never_saved_has_no_time(file, capsys):
    os.utime(file, (0, datetime(1980, 1, 1, 12).timestamp()))
    assert "99 fake.ipynb as it was handed out, in a fresh process" in said(capsys)
    os.utime(file, (0, datetime(2024, 5, 17, 9, 30).timestamp()))
    assert "as saved on 2024-05-17 at 09:30" in said(capsys)


def test_a_function_that_was_run_in_another_form_than_the_saved_one_is_named(file, capsys):
    changed = fake.SOLUTION.replace("return", "pass\n    return", 1)
    text = said(capsys, In=["", fake.SOLUTION, changed, CELL])
    assert text.startswith("not saved: ")
    assert "8 of 8 points" in text
    assert not said(capsys, In=["", changed, fake.SOLUTION, CELL]).startswith("not saved")
