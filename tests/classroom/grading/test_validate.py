"""A notebook's validation prints what the grader reports for the saved file."""

import os
from datetime import datetime

import pytest

from classroom.checks import validate
from tests.classroom.grading import fake
from tests.classroom.grading.conftest import notebook
from tests.classroom.grading.test_judge import judged

CELL = "from classroom.checks import validate\nvalidate()"


@pytest.fixture
def file(tmp_path, monkeypatch):
    """A saved notebook, and a kernel that was started for it."""
    path = tmp_path / "99 fake.ipynb"
    path.write_text(notebook(fake.SOLUTION, CELL), "utf-8")
    monkeypatch.setenv("JPY_SESSION_NAME", str(path))
    return path


def output_of(capsys, **names):
    exec(CELL, names)
    return capsys.readouterr().out


def test_the_file_is_judged_and_not_what_the_kernel_holds(file, capsys):
    text = output_of(capsys, double=None)
    assert text.startswith("99 fake.ipynb as saved at ")
    assert "✓ 99-turn · Turn a vector: 2.5 of 2.5 points" in text
    assert text.endswith("8 of 8 points\n")
    file.write_text(notebook("print(late)", "late = 1", fake.SOLUTION, CELL), "utf-8")
    assert "Cell 2 defines late" in " ".join(output_of(capsys).split())


def test_the_file_may_be_named_from_elsewhere_or_by_another_program(file, monkeypatch, capsys):
    monkeypatch.chdir(file.parent)
    monkeypatch.setenv("JPY_SESSION_NAME", f"some/folder/{file.name}")
    assert "8 of 8 points" in output_of(capsys)
    monkeypatch.delenv("JPY_SESSION_NAME")
    assert "8 of 8 points" in output_of(capsys, __vsc_ipynb_file__=str(file))


def test_an_unknown_file_asks_the_student_to_save(file, monkeypatch, capsys):
    for name in (None, "", "renamed.ipynb", "/nowhere/at all.ipynb", "console-1"):
        monkeypatch.delenv("JPY_SESSION_NAME", raising=False)
        if name is not None:
            monkeypatch.setenv("JPY_SESSION_NAME", name)
        text = output_of(capsys)
        assert "Save the notebook" in text
        assert "slamlab check" in text


def test_a_file_that_cannot_be_judged_is_reported_in_a_line(file, capsys):
    for text in ("", "{", "[1]"):
        file.write_text(text, "utf-8")
        assert output_of(capsys).splitlines()[-1].startswith(f"✗ {file}: ")


def test_under_nbgrader_and_in_a_worker_it_does_nothing(file, monkeypatch, capsys):
    graded = judged(fake.SOLUTION, CELL)
    assert graded["cells"] == {}
    assert all(verdict.full for verdict in graded["verdicts"])
    monkeypatch.setitem(os.environ, "NBGRADER_EXECUTION", "autograde")
    assert validate() is None
    assert capsys.readouterr().out == ""


def test_where_no_program_names_the_file_it_is_found_by_the_cells_that_ran(
    file, monkeypatch, capsys
):
    monkeypatch.delenv("JPY_SESSION_NAME")
    monkeypatch.chdir(file.parent)
    (file.parent / "other.ipynb").write_text(notebook("import math", "x = 1", CELL), "utf-8")
    (file.parent / "broken.ipynb").write_text("{", "utf-8")
    text = output_of(capsys, In=["", fake.SOLUTION, CELL])
    assert text.startswith("99 fake.ipynb as saved at ")
    assert "Save the notebook" in output_of(capsys, In=["", "import math"])


def test_after_a_new_name_no_other_file_is_taken_for_it(file, capsys):
    """The kernel keeps the old name: nothing may bear it now, or what was handed out again."""
    ran = ["", fake.SOLUTION, CELL]
    (file.parent / "an older copy.ipynb").write_text(file.read_text("utf-8"), "utf-8")
    assert output_of(capsys, In=ran).startswith("99 fake.ipynb as saved")
    file.rename(file.parent / "new name.ipynb")
    assert "If you renamed the notebook, first restart its kernel" in output_of(capsys, In=ran)
    file.write_text(notebook("def double(a):\n    raise NotImplementedError", CELL), "utf-8")
    assert "If you renamed the notebook, first restart its kernel" in output_of(capsys, In=ran)


def test_only_executed_code_that_differs_from_the_file_is_named(file, capsys):
    two = "def f():\n    return 1\n\nclass Mine:\n    step = f"
    trial = "@attempt\ndef _():\n    print({})"
    sources = [two, trial.format(1), trial.format(2), fake.SOLUTION, CELL]
    file.write_text(notebook(*sources), "utf-8")
    again = ["", two + "  # as before", trial.format(1), trial.format(2), trial.format(1)]
    assert "not saved" not in output_of(capsys, In=[*again, fake.SOLUTION, CELL])
    changed = two.replace("step = f", "step = None")
    output = [
        line for line in output_of(capsys, In=[*again, changed]).splitlines() if "not saved" in line
    ]
    assert [line.split()[4] for line in output] == ["Mine"]
    changed = fake.SOLUTION.replace("return", "pass\n    return", 1)
    text = output_of(capsys, In=["", fake.SOLUTION, changed, CELL])
    assert text.startswith("Your last version of double is not saved.")
    assert "8 of 8 points" in text
    assert "not saved" not in output_of(capsys, In=["", changed, fake.SOLUTION, CELL])


def test_a_file_that_was_never_saved_has_no_time(file, capsys):
    os.utime(file, (0, datetime(1980, 1, 1, 12).timestamp()))
    assert "99 fake.ipynb as it was handed out, run in a fresh process" in output_of(capsys)
    os.utime(file, (0, datetime(2024, 5, 17, 9, 30).timestamp()))
    assert "as saved on 2024-05-17 at 09:30" in output_of(capsys)
