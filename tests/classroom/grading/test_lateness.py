"""Lateness: days are counted on the course's clock, and the student reads how."""

from dataclasses import replace

import pytest

from classroom.exercises.verdict import Verdict
from classroom.grading import feedback
from classroom.grading.marks import mark
from classroom.grading.submissions import Submission
from classroom.grading.term import course_file, releases
from classroom.grading.term.term import load
from slamlab.cli import main
from tests.classroom.grading.conftest import table
from tests.classroom.grading.term_folder import ROSTER, attempt, stored

COURSE = """
time_zone = "Europe/Berlin"
[late]
grace_minutes = 10
per_day = 0.1
at_most = 0.5
[exercises.99]
due = {due}
"""


def policy(tmp_path, due):
    (tmp_path / "clock.toml").write_text(COURSE.format(due=due), "utf-8")
    return course_file.load(tmp_path / "clock.toml").policy()


@pytest.mark.parametrize(
    ("due", "handed_in", "days"),
    [
        ("2026-10-24T23:59:00", "2026-10-25T23:50:00+01:00", 1),  # a day of 25 hours
        ("2026-10-24T23:59:00", "2026-10-26T00:05:00+01:00", 2),
        ("2026-03-28T23:59:00", "2026-03-29T23:58:00+02:00", 1),  # a day of 23 hours
        ("2026-03-28T23:59:00", "2026-03-30T00:30:00+02:00", 2),
        ("2026-10-25T02:45:00", "2026-10-25T02:58:00+01:00", 1),  # the hour that is shown twice
        ("2026-03-28T23:59:00+01:00", "2026-03-29T00:09:00+01:00", 0),  # grace
    ],
)
def test_a_day_on_which_the_clock_changes_is_one_day(tmp_path, due, handed_in, days):
    late = policy(tmp_path, due).lateness("99", handed_in)
    assert (late.days if late else 0) == days


def test_the_page_states_due_date_grace_days_rate_and_points(tmp_path):
    rules = policy(tmp_path, "2026-03-28T23:59:00")
    made = mark(attempt("s1", 8, "2026-03-29T22:30:00+00:00"), policy=rules)
    sentence = (
        "Late penalty: 1.6 points (20 % of 8). Due on 2026-03-28 23:59 CET (up to 10 minutes "
        "later without a penalty); submitted on 2026-03-30 00:30 CEST: 2 days late, as each "
        "started day counts. A day costs 10 % of the points earned, all days together at most 50 %."
    )
    assert sentence in feedback.feedback_page(made) and sentence in feedback.feedback_text(made)
    assert sentence.removesuffix(".") in made.note


@pytest.mark.parametrize(
    ("due", "warning"),
    [
        ("2026-03-29T02:30:00", "the clock skips 2026-03-29 02:30; 03:30 counts"),
        ("2026-10-25T02:30:00", "the clock shows 2026-10-25 02:30 twice; the later time counts"),
        ("2026-10-25T03:30:00", None),
    ],
)
def test_a_due_time_that_the_clock_skips_or_shows_twice_is_warned_of(tmp_path, due, warning):
    (tmp_path / "c.toml").write_text(COURSE.format(due=due), "utf-8")
    course = course_file.load(tmp_path / "c.toml")
    expected = (f"due date of exercise 99: {warning}",) if warning else ()
    assert course.warnings(course.policy()) == expected


def test_an_extension_before_the_due_date_is_warned_of_and_has_no_effect(folder, capsys):
    (folder / "roster.csv").write_text(ROSTER.replace("2026-12-03", "2026-11-03"), "utf-8")
    stored(folder, attempt("s2", 8, "2026-12-01T10:00:00+00:00"))
    assert table(folder / "results/99/grades.csv")[1]["score"] == "8"
    assert main(["grade", "release", "99"]) == 0
    warning = "warning: extension of s2 in exercise 99: 2026-11-03 12:00 is before the due date"
    assert warning in capsys.readouterr().err


@pytest.mark.parametrize("command", [["release", "99"], ["adjust", "s3", "04-h-robot", "1"]])
def test_a_moved_due_date_renews_table_and_page_whichever_command_runs_next(folder, command):
    text = (folder / "course.toml").read_text("utf-8") + "[exercises.04]\n"
    (folder / "course.toml").write_text(text, "utf-8")
    other = attempt("s3", 0, name="s3-04.ipynb")
    stored(folder, attempt("s1", 8, "2026-12-01T11:00:01+00:00"), _as_04(other))
    (folder / "course.toml").write_text(text.replace("2026-12-01T12", "2026-12-01T18"), "utf-8")
    assert main(["grade", *command, *(["--reason", "x"] * (command[0] == "adjust"))]) == 0
    page = folder / "results/99/feedback" / f"{releases.file_name('s1')}.html"
    assert table(folder / "results/99/grades.csv")[0]["score"] == "8"
    assert "8 of 8 points" in page.read_text("utf-8")
    assert "Late penalty" not in page.read_text("utf-8")
    assert load(folder / "course.toml").warnings == ()


def _as_04(record):
    verdicts = (Verdict("04-h-robot", 0, 4),)
    return replace(record, exercise="04", verdicts=verdicts, titles={"04-h-robot": "H"})


def test_an_exercise_without_a_due_date_is_never_late(tmp_path):
    text = COURSE.replace("due = {due}", "")
    (tmp_path / "clock.toml").write_text(text, "utf-8")
    rules = course_file.load(tmp_path / "clock.toml").policy()
    assert rules.lateness("99", "2099-01-01T00:00:00+00:00") is None


def test_of_two_extensions_the_later_one_counts(folder):
    text = (folder / "course.toml").read_text("utf-8")
    for day in ("02", "04"):  # the roster extends to 3 December
        extension = f"[extensions.99]\ns2 = 2026-12-{day}T12:00:00\n"
        (folder / "course.toml").write_text(text + extension, "utf-8")
        due = load(folder / "course.toml").policy.due_for("99", "s2")
        assert due.day == max(3, int(day))


def test_without_a_worksheet_no_submission_in_moodles_download_is_late(folder):
    found = [Submission("Ana Kos_501_assignsubmission_file/x.ipynb", "Ana Kos", folder)]
    (joined,) = load(folder / "course.toml").join(found, "99")
    assert (joined.student, joined.handed_in) == ("s1", None)
    assert mark(attempt("s1", 8), policy=policy(folder, "2001-01-01")).late_penalty == 0
