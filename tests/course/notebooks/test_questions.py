"""Questions are stored separately, so that the code of notebooks does not reveal answers."""

import sys

import nbformat
import pytest

from classroom.checks import ask
from classroom.checks.question_files import load_question
from classroom.checks.question_widgets import wording
from classroom.coursework.progress_file import NAME
from course import question_cells
from course.derive import FOLDERS
from course.source import ROOT, read
from tests.course.notebooks import EXERCISES, LESSONS, name

NUMBER = """first()
ask(
    "04-far", "How far?", right=2.5, tolerance=0.1,
    unit="m", wrong={5.0: "that is the way there and back."},
)
last()"""


def test_a_notebook_asks_by_the_id_alone():
    assert question_cells.short(NUMBER) == 'first()\nask("04-far", unit="m")\nlast()'
    assert question_cells.short("x = 1") == "x = 1"


def test_what_is_computed_cannot_be_stored():
    computed = 'ask("04-a", "?", right=len(x), tolerance=1)'
    assert question_cells.asks(computed)
    with pytest.raises(ValueError):
        question_cells.asked(computed)


def questions(source):
    """What a source asks, in full."""
    code = [cell.text for cell in source.cells if cell.type == "code"]
    return [reported for reported in map(question_cells.asked, code) if reported]


@pytest.mark.parametrize("path", LESSONS + EXERCISES, ids=name)
def test_what_a_source_asks_in_full_is_what_its_notebooks_ask(path):
    source = read(path)
    found = questions(source)
    for reported in found:
        assert load_question(reported.pop("id")) == reported
    for folder in FOLDERS[source.kind]:
        notebook = nbformat.read(ROOT / folder / source.file, as_version=4)
        asking_cells = [cell for cell in notebook.cells if question_cells.asks(cell.source)]
        assert len(asking_cells) == len(found)
        for cell, reported in zip(asking_cells, found, strict=True):
            assert set(question_cells.asked(cell.source)) <= {"id", "unit"}
            shown = [each.data for each in cell.outputs if "text/markdown" in each.get("data", {})]
            words = wording(reported["text"], reported.get("choices"))
            assert all(data["text/markdown"] == data["text/plain"] == words for data in shown)
            assert len(shown) == (folder != "exercises")  # those are handed out without outputs


@pytest.mark.parametrize("path", EXERCISES, ids=name)
def test_an_exercise_asks_a_few_questions_and_what_answers_them_is_folded(path):
    source = read(path)
    assert 1 <= len(questions(source)) <= 3
    for folder in FOLDERS[source.kind]:
        for cell in nbformat.read(ROOT / folder / source.file, as_version=4).cells:
            if "answers" in cell.metadata.get("slamlab", {}):
                hidden = "outputs_hidden" if cell.cell_type == "code" else "source_hidden"
                assert cell.metadata["jupyter"][hidden]


def test_nobody_is_asked_where_nbgrader_runs_the_notebook(monkeypatch, tmp_path, capsys):
    for folder in ("notebooks", "exercises"):
        (tmp_path / folder).mkdir()
    monkeypatch.chdir(tmp_path / "exercises")
    monkeypatch.delenv("PYTEST_VERSION")
    monkeypatch.setenv("NBGRADER_EXECUTION", "autograde")
    monkeypatch.setitem(sys.modules, "ipywidgets", None)  # a grader may lack the widgets
    assert ask("ex06-who") is None
    assert capsys.readouterr().out == ""
    assert not (tmp_path / NAME).exists()


def test_an_unknown_question_is_reported():
    for id in ("04-nobody-asks", "99-x", "../../secret-1"):
        with pytest.raises(ValueError, match="is stored: give its text"):
            ask(id)
