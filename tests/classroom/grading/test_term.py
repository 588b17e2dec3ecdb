"""A term: each student has a row, each attempt a student, and the LMS can import the results."""

import csv
import io
import zipfile
from dataclasses import replace

import pytest

from classroom.exercises.verdict import Verdict
from classroom.grading import submissions
from classroom.grading.gradebook import Gradebook, default_url
from classroom.grading.records import Record
from classroom.grading.submissions import Submission
from classroom.grading.term import releases, student_matching, term
from slamlab.cli import main
from tests.classroom.grading import fake
from tests.classroom.grading.conftest import notebook, table, workers

COURSE = """
time_zone = "Europe/Zagreb"
attempts = "{attempts}"
isolation = "{level}"
[late]
per_day = 0.25
[exercises.99]
due = 2026-12-01T12:00:00
"""
ROSTER = """id,name,email,section,canvas,99
s1,Ana Kos,ana@uni.hr,Mon,1021,
s2,Ben Ivo,ben@uni.hr,Tue,1022,2026-12-03 12:00
s3,=Ćiro Šarić,,Tue,1023,
"""
SHEET = """\ufeffIdentifier,Full name,Email address,Status,Grade,Maximum grade,\
Last modified (submission),Last modified (grade),Feedback comments
Participant 501,Ana Kos,ana@uni.hr,,,10,"Wednesday, 2 December 2026, 9:00 AM",-,
Participant 502,Ben Ivo,ben@uni.hr,,,10,"Wednesday, 2 December 2026, 9:00 AM",-,
Participant 503,Ćiro,,,,10,-,-,
"""


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """The folder of a term, from which commands are given."""
    monkeypatch.chdir(tmp_path)
    begin(tmp_path)
    return tmp_path


def begin(folder, attempts="last"):
    text = COURSE.format(attempts=attempts, level=workers().level)
    (folder / "course.toml").write_text(text, "utf-8")
    (folder / "roster.csv").write_text(ROSTER, "utf-8")
    (folder / "sheet.csv").write_text(SHEET, "utf-8")


def scores(folder):
    return {row["id"]: row["score"] for row in table(folder / "results/99/grades.csv")}


def attempt(student, points, when=None, sha="a", name=None):
    verdicts = (Verdict("99-double", points, 8),)
    return Record(name or f"{student}.ipynb", student, "99", verdicts=verdicts, handed_in=when,
                  sha256=sha * 64, seed="b" * 64, titles={"99-double": "Double"})  # fmt: skip


def stored(folder, *records):
    """The term, with these attempts in its gradebook, in this order."""
    made = term.load(folder / "course.toml")
    made.course.results.mkdir(exist_ok=True)
    with Gradebook(default_url(made.course.results)) as book:
        for record in records:
            book.add(record)
        made.write(book)
        return made, made.exercise_results(book)


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


LATER = "2026-12-01T11:00:01+00:00"  # a second after noon in Zagreb


@pytest.mark.parametrize(("rule", "score"), [("last", "3"), ("best", "8")])
@pytest.mark.parametrize("swapped", [False, True])
def test_the_last_or_the_best_attempt_counts(folder, rule, score, swapped):
    begin(folder, rule)
    both = [
        replace(attempt("s1", 8, "2026-12-01T10:00:00+00:00"), seen=1),
        replace(attempt("s1", 4, LATER, "c", "s1b.ipynb"), seen=2),
    ]
    stored(folder, *(both[::-1] if swapped else both))
    assert scores(folder)["s1"] == score
    assert table(folder / "results/99/grades.csv")[0]["attempts"] == "2"


def test_no_time_that_a_student_can_set_makes_an_attempt_the_last(folder):
    early = "2001-01-01T00:00:00+00:00"
    older = replace(attempt("s1", 8, "2031-01-01T00:00:00+00:00"), seen=1)
    stored(folder, replace(attempt("s1", 5, early, "c", "s1b.ipynb"), seen=2), older)
    assert scores(folder)["s1"] == "5"


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
        "Another attempt, s1b.ipynb (2026-12-01 12:00 CET), does not count: it could not be "
        "graded: empty"
    )
    assert "Canvas marks it as late" in late["note"]


def test_a_submission_graded_as_two_exercises_does_not_count_twice(folder):
    refused = Record("s1.ipynb", "s1", "99", reason="exercise 04 by …", sha256="a" * 64)
    stored(folder, attempt("s1", 8), refused)
    assert table(folder / "results/99/grades.csv")[0]["status"] == "could not be graded"


def match_students(folder, *names, sheet=True):
    made = term.load(folder / "course.toml")
    made.keep_worksheet("99", folder / "sheet.csv", [])
    found = [submissions._submission(folder, folder / name) for name in names]
    return [s.student for s in made.join(found, "99" if sheet else None)]


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
    name = "Jan Novák_7_assignsubmission_file/x.ipynb"
    found = [Submission(name, "Jan Novák", folder, number="7")]
    found += [Submission("Jo.ipynb", "Jo", folder)]
    several, unknown = student_matching.match_students(found, made.roster)
    assert several.student == "several in the roster: Jan Novák (participant 7) is s1 or s2"
    assert unknown.student == "not in the roster: Jo"
    with Gradebook(default_url(folder)) as book:
        records = [attempt(s.student, 1, name=s.name) for s in (several, unknown)]
        lines = made.summary(book, records)
    assert lines[0].startswith("students not in roster.csv are only in submissions.csv: Jo. ")
    assert "with this name: Jan Novák (participant 7) is s1 or s2. Grade with" in lines[1]
    assert len(lines) == 2, "nobody's score can be released"


def test_a_release_has_the_forms_of_moodle_and_canvas(folder):
    moodle = "Ana Kos_501_assignsubmission_file/x.ipynb"
    canvas = "ivoben_LATE_1022_7_x-1.ipynb"
    both = attempt("s1", 8, LATER, name=moodle), attempt("s2", 5.5, name=canvas)
    made, found = stored(folder, *both)
    made.keep_worksheet("99", folder / "sheet.csv", [])
    words = made.course, made.roster, "99", found["99"], made.worksheet("99")
    message = releases.release(*words)
    out = folder / "results/99/release"
    sheet = {row["Identifier"]: row for row in table(out / "moodle.csv")}
    assert list(sheet["Participant 501"]) == next(csv.reader(io.StringIO(SHEET.strip("\ufeff"))))
    assert [sheet[f"Participant {n}"]["Grade"] for n in (501, 502, 503)] == ["6", "5.5", ""]
    assert sheet["Participant 502"]["Last modified (grade)"] == "-"
    header, possible, *rows = csv.reader((out / "canvas.csv").read_text("utf-8").splitlines())
    assert header == ["Student", "ID", "SIS User ID", "SIS Login ID", "Section", "A fake"]
    assert possible == ["Points Possible", "", "", "", "", "8"]
    assert [(row[1], row[5]) for row in rows] == [("1021", "6"), ("1022", "5.5"), ("1023", "")]
    with zipfile.ZipFile(out / "moodle-feedback.zip") as archive:
        first, second = archive.namelist()
        page = archive.read(first).decode()
    assert first == "Ana Kos_501_assignsubmission_file_/exercise-99-feedback.html"
    assert second == "Ben Ivo_502_assignsubmission_file_/exercise-99-feedback.html"
    assert "<title>Exercise 99: A fake · Ana Kos</title>" in page
    assert "submitted 2026-12-01 12:00 CET" in page
    with zipfile.ZipFile(out / "canvas-feedback.zip") as archive:
        assert archive.namelist() == ["ivoben_LATE_1022_7_exercise-99-feedback.html"]
    assert "the assignment has 10 points in Moodle, but 8 here" in "\n".join(message)
    text = (out / "feedback/s2.txt").read_text("utf-8")
    assert text.startswith("Exercise 99: A fake · Ben Ivo\n5.5 of 8 points\n")
    # after a change, the release lists it and replaces the earlier one
    (out / "stray").write_text("x")
    _, found = stored(folder, attempt("s2", 7, sha="d", name=canvas))
    message = releases.release(*words[:3], found["99"], words[4])
    assert message[-1] == "changed since the last release: Ben Ivo: 5.5 → 7"
    assert not (out / "stray").exists()


def test_a_comment_for_moodle_is_html_in_which_all_texts_are_escaped(folder):
    made, _ = stored(folder, attempt("s1", 8, "2026-12-01T10:00:00+00:00"))
    made.keep_worksheet("99", folder / "sheet.csv", [])
    with Gradebook(default_url(made.course.results)) as book:
        book.override_points(attempt("s1", 8), "99-double", 7, "P < 0 <script>")
        book.change("comment", attempt("s1", 8), exercise="99", text="line 1\nline 2")
        found = made.exercise_results(book)["99"]
    releases.release(made.course, made.roster, "99", found, made.worksheet("99"))
    sheet = table(folder / "results/99/release/moodle.csv")
    assert sheet[0]["Feedback comments"] == (
        "Double: set by hand to 7 points (P &lt; 0 &lt;script&gt;)<br>line 1<br>line 2"
    )


def test_submissions_have_columns_only_for_exercises_that_were_submitted(folder):
    text = (folder / "course.toml").read_text("utf-8") + "[exercises.04]\n"
    (folder / "course.toml").write_text(text, "utf-8")
    stored(folder, attempt("s1", 8))
    titles = list(table(folder / "results/submissions.csv")[0])
    assert "99-double: is twice as large" in titles
    assert not [title for title in titles if title.startswith("04")]


def test_the_column_of_marks_is_that_of_canvas_export_or_of_the_course_file(folder):
    text, export = (folder / "course.toml").read_text("utf-8"), "Student,ID,SIS User ID,{}\n"
    rows = export.format("A fake (77)") + '"Kos, Ana",1021,s1,\n'
    (folder / "roster.csv").write_text(rows, "utf-8")
    for line, title in (("", "A fake (77)"), ('canvas = "Homework (78)"\n', "Homework (78)")):
        (folder / "course.toml").write_text(text + line, "utf-8")
        made, found = stored(folder, attempt("s1", 8))
        releases.release(made.course, made.roster, "99", found["99"])
        row = table(folder / "results/99/release/canvas.csv")[1]
        assert (row["ID"], row[title]) == ("1021", "8")


def test_students_who_submitted_elsewhere_are_in_moodles_tables(folder):
    made, found = stored(folder, attempt("s2", 8, "2026-12-01T10:00:00+00:00", name="s2/x.ipynb"))
    made.keep_worksheet("99", folder / "sheet.csv", [])
    releases.release(made.course, made.roster, "99", found["99"], made.worksheet("99"))
    out, ben = folder / "results/99/release", "Ben Ivo_502_assignsubmission_file_"
    assert [row["Grade"] for row in table(out / "moodle.csv")] == ["", "8", ""]
    with zipfile.ZipFile(out / "moodle-feedback.zip") as archive:
        assert archive.namelist() == [f"{ben}/exercise-99-feedback.html"]


def test_a_student_no_longer_in_the_roster_is_reported(folder, capsys):
    stored(folder, attempt("old-id", 8))
    assert main(["grade", "release", "99"]) == 2
    line = "students no longer in roster.csv are only in submissions.csv: old-id"
    assert line in capsys.readouterr().err
    stored(folder, attempt("s1", 8))
    assert main(["grade", "release", "99"]) == 0
    assert "no longer in roster.csv" in capsys.readouterr().out
    assert {row["student"] for row in table(folder / "results/submissions.csv")} == {"s1", "old-id"}


def test_any_student_id_gives_a_valid_page_name():
    names = {releases.file_name(id) for id in ("s1", "../x", ".x", "a/b", "a%2fb", "š", "a b")}
    assert len(names) == 7
    assert all("/" not in name and not name.startswith(".") for name in names)


@pytest.mark.slow
def test_a_term_from_download_to_release_from_the_command_line(folder, capsys):
    with zipfile.ZipFile(folder / "download.zip", "w") as archive:
        archive.writestr("Ana Kos_501_assignsubmission_file/hw.ipynb", notebook(fake.SOLUTION))
        archive.writestr("Zed_509_assignsubmission_file/hw.ipynb", notebook(exercise="04"))
    words = ["grade", "download.zip", "--exercise", "99"]
    assert main([*words, "--worksheet", "sheet.csv"]) == 1  # Zed is not in the roster
    output = capsys.readouterr().out
    assert "students not in roster.csv are only in submissions.csv: Zed (participant 509)" in output
    assert "slamlab grade release 99" in output
    assert "class.html, 99/feedback/" in output
    assert scores(folder) == {"s1": "6", "s2": "", "s3": ""}
    assert main(["grade", "adjust", "s1", "99-turn", "0.5", "--reason", "agreed"]) == 0
    assert scores(folder)["s1"] == "4.5"
    assert main(words) == 1  # the worksheet, the policy and the secret were kept
    assert scores(folder)["s1"] == "4.5"
    assert main(["grade", "release", "99", "--as", "Prof. X"]) == 0
    head = capsys.readouterr().out.strip().rsplit(" ", 1)[1]
    assert (folder / "results/99/release/moodle.csv").exists()
    with Gradebook(default_url(folder / "results")) as book:
        last = book.rows()[-1]
        assert (last["kind"], last["who"], last["hash"]) == ("release", "Prof. X", head)
    assert main(["grade", "verify", "--head", head]) == 0
    assert "1 of 1 scores verified" in capsys.readouterr().out
    assert main(["grade", "verify", "--head", "0" * 64]) == 1
    assert "removed or rewritten" in capsys.readouterr().out
    assert main(["grade", "verify", "--head", "zzz"]) == 2
    assert "not a ledger head" in capsys.readouterr().err
    assert main(["grade", "adjust", "s1", "99-turn", "0.5", "--reason", " "]) == 2
    assert "--reason is empty" in capsys.readouterr().err
    capsys.readouterr()
    assert main(["grade", "forget", "ana kos"]) == 2
    assert "Did you mean the id 's1'?" in capsys.readouterr().err
    assert main(["grade", "forget", "s1"]) == 0
    assert "Delete the student's line in roster.csv" in capsys.readouterr().out
    assert not list((folder / "results").rglob("feedback/s1.*"))
    sheet = (folder / "results/99/worksheet.csv").read_text("utf-8")
    assert "Participant 502" in sheet and "Ana Kos" not in sheet and "ana@uni.hr" not in sheet
    assert scores(folder)["s1"] == ""
    assert main(["grade", "verify", "--head", head]) == 0
    assert main(["grade", "forget", "s1"]) == 2
    assert main(words) == 1
    listed = table(folder / "results/submissions.csv")
    assert [row["student"] for row in listed] == ["s1", "not in the roster: Zed (participant 509)"]
    assert "exercise 04 according to its metadata" in listed[1]["note"]


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["x", "--exercise", "04"], "the course file has no exercise 04. It has the exercises 99"),
        (["x", "--worksheet", "sheet.csv"], "--worksheet needs a course file and --exercise"),
        (["x", "--course", "course.toml", "--out", "out"], "course.toml also sets --out"),
        (["x", "--policy", "p.toml"], "course.toml also sets --policy"),
        (["x", "--course", "no.toml"], "no.toml: No such file"),
        (["release", "04"], "the course file has no exercise 04"),
        (["release", "99"], "does not exist: grade submissions first"),
        (["similarity", "04"], "the course file has no exercise 04. It has the exercises 99"),
        (["adjust", "s2", "99-turn", "1", "--reason", "x"], "does not exist: grade submissions"),
    ],
)
def test_wrong_use_in_a_term_is_reported_in_one_line(folder, words, message, capsys):
    (folder / "x").mkdir()
    assert main(["grade", *words]) == 2
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1


def test_a_missing_roster_or_course_file_is_reported_with_the_remedy(folder, capsys):
    (folder / "x").mkdir()
    for words, lost, message in (
        (["x"], "roster.csv", "roster.csv does not exist. Create a table"),
        (["x"], "course.toml", "no course file here. Write one with slamlab grade init"),
        (["release", "04"], "sheet.csv", "a release needs a course file"),
    ):
        (folder / lost).unlink()
        assert main(["grade", *words]) == 2
        assert message in capsys.readouterr().err
