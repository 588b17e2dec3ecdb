"""A term: each student has a row, each attempt a student, and the last or best attempt counts."""

from dataclasses import replace

import pytest

from classroom.grading.gradebook import Gradebook, default_url
from classroom.grading.records import Record
from classroom.grading.submissions import Submission
from classroom.grading.term import student_matching, term
from slamlab.cli import main
from tests.classroom.grading.conftest import table
from tests.classroom.grading.term_folder import (
    LATER,
    attempt,
    begin,
    match_students,
    scores,
    stored,
)


def test_a_student_without_a_submission_has_a_row(folder):
    stored(folder, attempt("s1", 8))
    assert scores(folder) == {"s1": "8", "s2": "", "s3": ""}
    rows = table(folder / "results/99/grades.csv")
    assert [row["status"] for row in rows] == ["graded", "not submitted", "not submitted"]
    over_all = table(folder / "results/grades.csv")
    assert [(row["id"], row["99"], row["total"]) for row in over_all] == [
        ("s1", "8", "8"), ("s2", "", "0"), ("s3", "", "0"),
    ]  # fmt: skip
    assert over_all[2]["name"] == "'=Ćiro Šarić"


DAYS = "2001-01-01", "2026-12-01", "2031-01-01"
EARLY, SOON, LATEST = (f"{day}T10:00:00+00:00" for day in DAYS)


@pytest.mark.parametrize(
    ("rule", "times", "score"),
    [("last", (SOON, LATER), "3"), ("best", (SOON, LATER), "8"), ("last", (LATEST, EARLY), "4")],
    ids=["last", "best", "the last to be read, whatever time a student sets"],
)
@pytest.mark.parametrize("swapped", [False, True])
def test_the_last_or_the_best_attempt_counts(folder, rule, times, score, swapped):
    begin(folder, rule)
    both = [
        replace(attempt("s1", 8, times[0]), seen=1),
        replace(attempt("s1", 4, times[1], "c", "s1b.ipynb"), seen=2),
    ]
    stored(folder, *(both[::-1] if swapped else both))
    assert scores(folder)["s1"] == score
    assert table(folder / "results/99/grades.csv")[0]["attempts"] == "2"


def test_lateness_counts_against_the_late_one_of_the_best_attempts(folder):
    begin(folder, "best")
    stored(folder, attempt("s1", 7, "2026-12-01T10:00:00+00:00"), attempt("s1", 8, LATER, "c"))
    assert scores(folder)["s1"] == "7"


def test_an_extension_moves_the_due_date_of_one_student(folder):
    stored(folder, attempt("s1", 8, LATER), attempt("s2", 8, LATER))
    assert scores(folder) == {"s1": "6", "s2": "8", "s3": ""}
    rows = table(folder / "results/99/grades.csv")
    assert [row["due"] for row in rows] == [
        "2026-12-01 12:00", "2026-12-03 12:00", "2026-12-01 12:00",
    ]  # fmt: skip
    assert rows[0]["submitted"] == "2026-12-01 12:00"
    text = (folder / "course.toml").read_text().replace("2026-12-01T12", "2026-12-01T18")
    (folder / "course.toml").write_text(text)
    stored(folder)
    assert scores(folder)["s1"] == "8", "a later due date counts for earlier attempts"


def test_an_unreadable_attempt_does_not_replace_a_graded_one_and_a_late_one_is_noted(folder):
    broken = Record("s1b.ipynb", "s1", "99", reason="empty", handed_in=LATER)
    stored(folder, attempt("s1", 8, "2026-12-01T10:00:00+00:00"), broken)
    stored(folder, attempt("s2", 8, name="ivoben_LATE_1022_7_x.ipynb"))
    row, late, _ = table(folder / "results/99/grades.csv")
    assert row["score"] == "8" and row["note"] == (
        "Another attempt, s1b.ipynb (2026-12-01 12:00 CET), does not count; it could not be "
        "graded: empty"
    )
    assert "Canvas marks it as late" in late["note"]


def test_a_submission_graded_as_two_exercises_does_not_count_twice(folder):
    refused = Record("s1.ipynb", "s1", "99", reason="exercise 04 by …", sha256="a" * 64)
    stored(folder, attempt("s1", 8), refused)
    assert table(folder / "results/99/grades.csv")[0]["status"] == "could not be graded"


def test_only_the_roster_and_the_download_identify_students(folder):
    for name, student in {
        "Ana Kos_501_assignsubmission_file/s2.ipynb": "s1",
        "Nobody_502_assignsubmission_file/x.ipynb": "s2",
        "eve_1021_7_s2_1022_8_x.ipynb": "s1",
        "s1.ipynb": "s1",
        "ben@uni.hr/x.ipynb": "s2",
        "ana kos.ipynb": "s1",
        "s2_599_assignsubmission_file/x.ipynb": "not in the roster: s2 (participant 599)",
        "s1_9999_7_s1.ipynb": f"{student_matching.NOT_IN_ROSTER}s1",
        "somebody.ipynb": f"{student_matching.NOT_IN_ROSTER}somebody",
    }.items():
        assert match_students(folder, name) == [student]


def test_two_participants_of_one_name_are_reported(folder):
    made = term.load(folder / "course.toml")
    names = [f"Ana Kos_{n}_assignsubmission_file/x.ipynb" for n in (7, 8)]
    found = [Submission(name, "Ana Kos", folder, number=name[8]) for name in names]
    both = student_matching.match_students(found, made.roster)
    assert all("participants 7, 8 all have the name Ana Kos" in s.problem for s in both)
    assert len({s.student for s in both}) == 2 and not {s.student for s in both} & {"s1"}
    elsewhere = [Submission("kosana_1021_7_x.ipynb", "kosana", folder, number="1021"), found[0]]
    elsewhere.append(Submission("s1/x.ipynb", "s1", folder))
    found = student_matching.match_students(elsewhere, made.roster)
    assert [(s.student, s.problem) for s in found] == [("s1", None)] * 3


def test_two_students_of_one_name_in_the_roster_are_reported_as_several(folder):
    roster = "id,name\ns1,Jan Novák\ns2,Jan Novák\ns3,Eva Horak\n"
    (folder / "roster.csv").write_text(roster, "utf-8")
    made = term.load(folder / "course.toml")
    found = [
        Submission(f"Jan Novák_{n}_assignsubmission_file/x.ipynb", "Jan Novák", folder, number=n)
        for n in "78"
    ]
    found += [Submission("Jo.ipynb", "Jo", folder)]
    several, other, unknown = student_matching.match_students(found, made.roster)
    assert several.student == "several in the roster: Jan Novák (participant 7) is s1 or s2"
    assert other.student != several.student, "their files are not attempts of one person"
    assert unknown.student == "not in the roster: Jo"
    message = "'jan novák' is the name of s1 and s2 in the roster; give the id"
    assert made.roster.not_one("jan novák") == message
    with Gradebook(default_url(folder)) as book:
        records = [attempt(s.student, 1, name=s.name) for s in (several, unknown)]
        lines = made.summary(book, records)
    assert lines[0].startswith("students not in roster.csv are only in submissions.csv: Jo. ")
    assert "with this name: Jan Novák (participant 7) is s1 or s2. Grade with" in lines[1]
    assert len(lines) == 2, "nobody's score can be released"


def test_an_unknown_id_whose_file_was_graded_again_as_a_student_is_named_with_the_student(folder):
    made = term.load(folder / "course.toml")
    unknown = attempt("not in the roster: s11", 1)
    (line,) = made.unmatched([unknown, attempt("s1", 1), attempt("s2", 1, sha="c")])
    assert "submissions.csv: s11 (the same file as of s1). Name" in line
    (line,) = made.unmatched([unknown, attempt("s2", 1, sha="c")])
    assert "submissions.csv: s11. Name" in line


def test_a_student_no_longer_in_the_roster_is_reported(folder, capsys):
    stored(folder, attempt("old-id", 8))
    assert main(["grade", "release", "99"]) == 2
    line = "students no longer in roster.csv are only in submissions.csv: old-id"
    assert line in capsys.readouterr().err
    stored(folder, attempt("s1", 8))
    assert main(["grade", "release", "99"]) == 0
    assert "no longer in roster.csv" in capsys.readouterr().out
    assert {row["student"] for row in table(folder / "results/submissions.csv")} == {"s1", "old-id"}
