"""Before a notebook is handed in, its student hears what grading would trip over."""

import pytest

from slamlab.cli import main
from slamlab.grading import preflight
from tests.grading import fake
from tests.grading.conftest import notebook


def checked(tmp_path, capsys, *cells):
    file = tmp_path / "anna.ipynb"
    file.write_text(notebook(*cells))
    code = main(["check", str(file)])
    return code, " ".join(capsys.readouterr().out.split())


@pytest.mark.slow
@pytest.mark.parametrize(
    ("cells", "said"),
    [
        (["print(late)", "late = 1"], "Cell 2 defines late, but cells are graded from"),
        (["print(deleted)"], "Was its cell deleted?"),
        (["from slamlab.geometry import wrap"], "slamlab.geometry is not there at grading; this "
         "exercise may use slamlab.models.noise"),
        (["import nowhere"], "No module named 'nowhere'"),
    ],
)  # fmt: skip
def test_what_goes_wrong_with_the_form_is_told_with_the_way_out(tmp_path, capsys, cells, said):
    code, text = checked(tmp_path, capsys, *cells, fake.SOLUTION)
    assert code == 0  # the tasks themselves are solved
    assert "cell 1 did not run to its end" in text
    assert said in text


def test_missing_tasks_are_named_and_a_failure_is_told_in_full(tmp_path, capsys):
    broken = "def turn(v, angle):\n    raise ValueError('angle must not be negative')"
    code, text = checked(tmp_path, capsys, fake.SOLUTION, "del double", broken)
    assert code == 1
    assert "double is not defined" in text
    assert "ValueError: angle must not be negative (line 2 of the cell, in turn)" in text


def test_a_slow_notebook_is_warned_of():
    assert preflight.form_warnings([], {}, fake.EXERCISE, 10.0) == []
    assert "grading stops" in preflight.form_warnings([], {}, fake.EXERCISE, 100.0)[0]
