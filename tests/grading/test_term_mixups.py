"""What a lecturer mixes up, or a student hands in twice, takes nothing from anybody."""

import zipfile
from dataclasses import replace

import pytest

from slamlab.cli import main
from slamlab.exercises.verdict import Verdict
from slamlab.grading import feedback
from slamlab.grading.marks import mark
from slamlab.grading.submissions import by_name
from slamlab.grading.term import standings
from tests.grading import fake
from tests.grading.conftest import notebook
from tests.grading.test_term import attempt, begin, folder, scores

__all__ = ["begin", "folder"]  # a fixture


def ungraded(record, exercise):
    """The same file, taken for another exercise."""
    return replace(record, exercise=exercise, verdicts=(), seed=None, reason="it is another one")


def counted(*records):
    """Points by exercise of one student's attempts, in this order."""
    kept = standings._newest_of_each_content([mark(record) for record in records])
    return {made.record.exercise: made.total for made in kept}


def test_what_was_graded_stays_whatever_else_the_file_is_taken_for():
    graded = attempt("s1", 8)
    for other in ("04", "07"):
        assert counted(graded, ungraded(graded, other)) == {"99": 8, other: None}


def test_what_could_not_be_graded_gives_way_to_what_is_made_of_it_later():
    graded = attempt("s1", 8)
    assert counted(ungraded(graded, "04"), ungraded(graded, "07"), graded) == {"99": 8}


def test_points_set_by_hand_count_in_their_own_exercise_only():
    graded = attempt("s1", 8)
    by_hand = {("s1.ipynb", "99-double"): (2.0, "agreed"), ("s1.ipynb", "04-h-robot"): (1.0, "")}
    assert mark(graded, by_hand).points == {"99-double": 2.0}
    assert mark(ungraded(graded, "04"), by_hand).points == {"04-h-robot": 1.0}


def test_a_download_graded_as_another_exercise_takes_no_marks_and_is_told(folder, capsys):
    with zipfile.ZipFile(folder / "download.zip", "w") as archive:
        archive.writestr("Ana Kos_501_assignsubmission_file/hw.ipynb", notebook(fake.SOLUTION))
    text = (folder / "course.toml").read_text("utf-8")
    due = "[exercises.04]\ndue = 2026-12-01T12:00:00\n"
    (folder / "course.toml").write_text(text + due, "utf-8")
    assert main(["grade", "download.zip", "--exercise", "99"]) == 0
    before = scores(folder)
    assert before["s1"] == "8"
    assert main(["grade", "download.zip", "--exercise", "04"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "1 of 1 could not be graded, but were as exercise 99 before" in said
    assert scores(folder) == before


def test_a_worksheet_of_another_assignment_is_refused_before_it_is_kept(folder, capsys):
    with zipfile.ZipFile(folder / "download.zip", "w") as archive:
        archive.writestr("Ana Kos_777_assignsubmission_file/hw.ipynb", notebook(fake.SOLUTION))
    words = ["grade", "download.zip", "--exercise", "99", "--worksheet", "sheet.csv"]
    assert main(words) == 2
    assert "none of the download's participants stands in it" in capsys.readouterr().err
    assert not list((folder / "results").rglob("worksheet.csv"))


@pytest.mark.parametrize(
    "names",
    [["ex04.ipynb", "ex04 (1).ipynb"], ["a/2.ipynb", "a/10.ipynb"], ["hw.ipynb", "hw-1.ipynb"]],
)
def test_a_copy_comes_after_what_it_is_a_copy_of(names):
    assert sorted(reversed(names), key=by_name) == names


def test_a_page_agrees_with_itself_on_points_set_by_hand():
    verdicts = (Verdict("99-double", 6, 8, problem="it is half of it"),)
    judged = replace(attempt("s1", 6), verdicts=verdicts)
    made = mark(judged, {("s1.ipynb", "99-double"): (7.0, "agreed")})
    page = " ".join(feedback.feedback_page(made).split())
    assert "7 of 8 points, set by hand; 6 by the laws" in page
    assert "To gain 1 point:" in page
