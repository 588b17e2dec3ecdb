"""A release of a term's results: tables that the LMS imports, made from the command line."""

import csv
import io
import zipfile

import pytest

from classroom.grading.gradebook import Gradebook, default_url
from classroom.grading.term import releases
from slamlab.cli import main
from tests.classroom.grading import fake
from tests.classroom.grading.conftest import notebook, table
from tests.classroom.grading.term_folder import LATER, SHEET, attempt, scores, stored


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
        (["release", "99", "--out", "graded"], "a release needs a course file"),
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
