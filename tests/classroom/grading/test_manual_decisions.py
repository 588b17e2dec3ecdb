"""Changes by hand belong to one attempt: at a new attempt, nothing is kept or lost in silence."""

from dataclasses import replace

import pytest

from classroom.exercises.verdict import Verdict
from classroom.grading import feedback
from classroom.grading.gradebook import Gradebook, default_url
from classroom.grading.records import Record
from classroom.grading.remarks import COMMENT
from classroom.grading.term.term import load
from slamlab.cli import main
from tests.classroom.grading.conftest import table
from tests.classroom.grading.term_folder import attempt, begin, stored

OLD = replace(attempt("s1", 5.0, "2026-12-01T09:00:00+00:00"), seen=1)
NEW = replace(attempt("s1", 8.0, "2026-12-01T10:00:00+00:00", "c"), seen=2)
RENAMED = replace(NEW, submission="s1-1.ipynb")  # Canvas gives each upload another name


def changed(folder, *changes):
    """The term and its results after changes of an opened gradebook."""
    made = load(folder / "course.toml")
    with Gradebook(default_url(made.course.results)) as book:
        for change in changes:
            change(book)
        made.write(book)
        return made, made.exercise_results(book)["99"][0]


def row(folder):
    return table(folder / "results/99/grades.csv")[0]


@pytest.mark.parametrize("new", [NEW, RENAMED], ids=["same name", "another name"])
def test_points_set_by_hand_count_for_their_attempt_alone(folder, new, capsys):
    stored(folder, OLD)
    assert main(["grade", "adjust", "s1", "99-double", "2", "--reason", "right idea"]) == 0
    assert row(folder)["score"] == "2"
    stored(folder, new)
    assert row(folder)["score"] == "8"
    clause = "Double was set by hand to 2 points (right idea) on s1.ipynb; the attempt that counts"
    assert f"to be decided: {clause} earns 8" in row(folder)["note"]
    assert main(["grade", "release", "99"]) == 0
    output = capsys.readouterr().out
    assert f"s1: {clause} earns 8. Decide: slamlab grade adjust s1 99-double POINTS" in output


@pytest.mark.parametrize(("points", "score"), [("2", "2"), ("auto", "8")])
def test_a_grader_decides_whether_points_set_by_hand_count_for_the_new_attempt(
    folder, points, score
):
    stored(folder, OLD)
    changed(folder, lambda book: book.override_points(OLD, "99-double", 2, "right idea"))
    stored(folder, NEW)
    assert main(["grade", "adjust", "s1", "99-double", points, "--reason", "decided"]) == 0
    assert row(folder)["score"] == score and "to be decided" not in row(folder)["note"]


def test_equal_points_need_no_decision(folder):
    stored(folder, OLD, NEW)
    _, result = changed(folder, lambda book: book.override_points(OLD, "99-double", 8, "right"))
    assert result.undecided == {}


def test_a_row_of_an_older_version_belongs_to_the_name(folder):
    stored(folder, OLD, NEW)
    old = {"exercise": "99", "task": "99-double", "points": 2.0, "reason": "right idea"}
    _, result = changed(folder, lambda book: book.note("override", old, "s1.ipynb"))
    assert result.total == 2


def test_a_comment_on_an_earlier_attempt_is_shown_as_such_until_it_is_replaced(folder):
    stored(folder, OLD, NEW)

    def comment(record, text):
        return lambda book: book.change(COMMENT, record, exercise="99", text=text)

    _, result = changed(folder, comment(OLD, "only update was wrong"))
    text = feedback.feedback_text(result.mark)
    assert "Remark on s1.ipynb (2026-12-01 10:00 CET): only update was wrong" in text
    for new in ("all is right", ""):
        _, result = changed(folder, comment(NEW, new))
        assert "only update" not in row(folder)["note"] and new in row(folder)["note"]


def test_points_of_an_ungraded_submission_state_which_tasks_count_0(folder, capsys):
    lost = Record("s1.ipynb", "s1", "99", reason="the file is empty", sha256="e" * 64)
    stored(folder, lost)
    assert main(["grade", "adjust", "s1", "99-double", "3.5", "--reason", "on paper"]) == 0
    sentence = "These tasks have no points and count as 0: Turn a vector, Double a sum"
    assert sentence in capsys.readouterr().out
    assert row(folder)["score"] == "3.5" and sentence in row(folder)["note"]


def blank(name, sha, seen):
    """An attempt as the notebook is handed out."""
    verdicts = (Verdict("99-double", 0, 8, kind="not attempted", problem="not attempted yet"),)
    return replace(attempt("s1", 0, sha=sha, name=name), verdicts=verdicts, seen=seen)


@pytest.mark.parametrize("rule", ["last", "best"])
def test_a_notebook_without_a_solution_never_replaces_a_worked_one(folder, rule):
    begin(folder, rule)
    worked = replace(attempt("s1", 8, LAST, name="s1/ex99.ipynb"), seen=1)
    _, found = stored(folder, worked, blank("s1/ex99 - Copy.ipynb", "c", 2))
    assert found["99"][0].mark.record.submission == worked.submission
    for text in (row(folder)["note"], feedback.feedback_text(found["99"][0].mark)):
        assert "ex99 - Copy.ipynb, does not count; it contains no solution" in text


LAST = "2026-12-01T10:00:00+00:00"


def test_the_row_and_the_page_name_the_other_file_and_what_it_would_earn(folder):
    one = replace(attempt("s1", 8, LAST, name="s1/a.ipynb"), seen=1)
    two = replace(attempt("s1", 5, LAST, "c", "s1/b.ipynb"), seen=2)
    _, found = stored(folder, one, two)
    sentence = (
        "a.ipynb (2026-12-01 11:00 CET), does not count, because the last attempt counts; it would "
        "earn 8 of 8 points"
    )
    assert row(folder)["submission"] == "s1/b.ipynb" and sentence in row(folder)["note"]
    assert sentence in feedback.feedback_page(found["99"][0].mark)
