"""Mistakes of lecturers and repeated submissions cost no student points."""

import zipfile
from dataclasses import replace

from classroom.exercises.verdict import Verdict
from classroom.grading import feedback
from classroom.grading.marks import mark
from classroom.grading.submissions import by_name
from classroom.grading.term import exercise_results
from slamlab.cli import main
from tests.classroom.grading import fake
from tests.classroom.grading.conftest import notebook
from tests.classroom.grading.term_folder import attempt, scores


def ungraded(record, exercise):
    """The same file, taken for another exercise."""
    return replace(record, exercise=exercise, verdicts=(), seed=None, reason="it is another one")


def counted(*records):
    """Points by exercise of one student's attempts, in this order."""
    kept = exercise_results._newest_of_each_content([mark(record) for record in records])
    return {made.record.exercise: made.total for made in kept}


def test_a_grade_stays_if_the_file_is_graded_as_another_exercise():
    graded = attempt("s1", 8)
    for other in ("04", "07"):
        assert counted(graded, ungraded(graded, other)) == {"99": 8, other: None}
    assert counted(ungraded(graded, "04"), ungraded(graded, "07"), graded) == {"99": 8}


def test_an_override_counts_only_in_its_exercise():
    graded = attempt("s1", 8)
    a = "s1.ipynb", "a" * 64
    by_hand = {(*a, "99-double"): (2.0, "agreed"), (*a, "04-h-robot"): (1.0, "")}
    assert mark(graded, by_hand).points == {"99-double": 2.0}
    assert mark(ungraded(graded, "04"), by_hand).points == {"04-h-robot": 1.0}


def test_a_download_graded_as_another_exercise_keeps_its_marks_and_is_reported(folder, capsys):
    with zipfile.ZipFile(folder / "download.zip", "w") as archive:
        archive.writestr("Ana Kos_501_assignsubmission_file/hw.ipynb", notebook(fake.SOLUTION))
    text = (folder / "course.toml").read_text("utf-8")
    due = "[exercises.04]\ndue = 2026-12-01T12:00:00\n"
    (folder / "course.toml").write_text(text + due, "utf-8")
    assert main(["grade", "download.zip", "--exercise", "99"]) == 0
    before = scores(folder)
    assert before["s1"] == "8"
    assert main(["grade", "download.zip", "--exercise", "04"]) == 1
    output = " ".join(capsys.readouterr().out.split())
    assert "1 of 1 could not be graded, but were graded as exercise 99 before" in output
    assert scores(folder) == before


def test_a_worksheet_of_another_assignment_is_refused_before_it_is_kept(folder, capsys):
    with zipfile.ZipFile(folder / "download.zip", "w") as archive:
        archive.writestr("Ana Kos_777_assignsubmission_file/hw.ipynb", notebook(fake.SOLUTION))
    words = ["grade", "download.zip", "--exercise", "99", "--worksheet", "sheet.csv"]
    assert main(words) == 2
    assert "it contains none of the download's participants" in capsys.readouterr().err
    assert not list((folder / "results").rglob("worksheet.csv"))


def test_a_copy_follows_its_original():
    for names in (["ex04.ipynb", "ex04 (1).ipynb"], ["a/2.ipynb", "a/10.ipynb"]):
        assert sorted(reversed(names), key=by_name) == names


def test_a_feedback_page_is_consistent_about_overrides():
    verdicts = (Verdict("99-double", 6, 8, problem="it is half of it"),)
    judged = replace(attempt("s1", 6), verdicts=verdicts)
    made = mark(judged, {("s1.ipynb", "a" * 64, "99-double"): (7.0, "agreed")})
    page = " ".join(feedback.feedback_page(made).split())
    assert "7 of 8 points, set by hand; 6 by the autograder" in page
    assert "To gain 1 point:" in page
