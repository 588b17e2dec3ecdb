"""A term: everybody has a row, each attempt is somebody's, and what goes back fits the LMS."""

import csv
import io
import zipfile
from dataclasses import replace

import pytest

from slamlab.cli import main
from slamlab.exercises.verdict import Verdict
from slamlab.grading import submissions
from slamlab.grading.gradebook import Gradebook, default_url
from slamlab.grading.records import Record
from slamlab.grading.submissions import Submission
from slamlab.grading.term import enrolment, releases, term
from tests.grading import fake
from tests.grading.conftest import notebook, workers

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


def table(path):
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


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
        return made, made.standings(book)


def test_who_handed_in_nothing_has_a_row(folder):
    stored(folder, attempt("s1", 8))
    assert scores(folder) == {"s1": "8", "s2": "", "s3": ""}
    rows = table(folder / "results/99/grades.csv")
    assert [row["status"] for row in rows] == ["graded", "nothing handed in", "nothing handed in"]
    over_all = table(folder / "results/grades.csv")
    assert [(row["id"], row["99"], row["total"]) for row in over_all] == [
        ("s1", "8", "8"), ("s2", "", "0"), ("s3", "", "0"),
    ]  # fmt: skip
    assert over_all[2]["name"] == "'=Ćiro Šarić"


LATER = "2026-12-01T11:00:01+00:00"  # a second after noon in Zagreb


@pytest.mark.parametrize(("rule", "score"), [("last", "3"), ("best", "8")])
@pytest.mark.parametrize("swapped", [False, True])
def test_the_attempt_that_was_seen_last_or_the_best_counts(folder, rule, score, swapped):
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


def test_of_the_best_attempts_lateness_counts_against_the_late_one(folder):
    begin(folder, "best")
    stored(folder, attempt("s1", 7, "2026-12-01T10:00:00+00:00"), attempt("s1", 8, LATER, "c"))
    assert scores(folder)["s1"] == "7"


def test_an_extension_moves_what_is_due_for_one_student_only(folder):
    stored(folder, attempt("s1", 8, LATER), attempt("s2", 8, LATER))
    assert scores(folder) == {"s1": "6", "s2": "8", "s3": ""}
    rows = table(folder / "results/99/grades.csv")
    assert [row["due"] for row in rows] == [
        "2026-12-01 12:00", "2026-12-03 12:00", "2026-12-01 12:00",
    ]  # fmt: skip
    assert rows[0]["handed_in"] == "2026-12-01 12:00"


def test_a_moved_due_date_counts_for_what_was_graded_before(folder):
    stored(folder, attempt("s1", 8, LATER))
    text = (folder / "course.toml").read_text().replace("2026-12-01T12", "2026-12-01T18")
    (folder / "course.toml").write_text(text)
    stored(folder)
    assert scores(folder)["s1"] == "8"


def test_an_attempt_that_cannot_be_read_hides_none_that_was_graded(folder):
    broken = Record("s1b.ipynb", "s1", "99", reason="empty", handed_in=LATER)
    stored(folder, attempt("s1", 8, "2026-12-01T10:00:00+00:00"), broken)
    row = table(folder / "results/99/grades.csv")[0]
    assert (row["score"], row["note"]) == ("8", "1 more could not be graded")


def test_what_was_graded_as_another_exercise_before_does_not_count_twice(folder):
    refused = Record("s1.ipynb", "s1", "99", reason="exercise 04 by …", sha256="a" * 64)
    stored(folder, attempt("s1", 8), refused)
    assert table(folder / "results/99/grades.csv")[0]["status"] == "could not be graded"


def joined(folder, *names, sheet=True):
    made = term.load(folder / "course.toml")
    made.keep_worksheet("99", folder / "sheet.csv", [])
    found = [submissions._submission(folder, folder / name) for name in names]
    return [s.student for s in made.join(found, "99" if sheet else None)]


def test_identity_comes_from_the_roster_and_the_place_in_a_download_only(folder):
    assert joined(folder, "Ana Kos_501_assignsubmission_file/s2.ipynb") == ["s1"]
    assert joined(folder, "Nobody_502_assignsubmission_file/x.ipynb") == ["s2"]
    assert joined(folder, "eve_1021_7_s2_1022_8_x.ipynb") == ["s1"]
    assert joined(folder, "s1.ipynb", "ben@uni.hr/x.ipynb", "ana kos.ipynb") == ["s1", "s2", "s1"]
    stranger = enrolment.STRANGER
    assert joined(folder, "s2_599_assignsubmission_file/x.ipynb") == [f"{stranger}s2"]
    assert joined(folder, "s1_9999_7_s1.ipynb") == [f"{stranger}s1"]
    assert joined(folder, "somebody.ipynb") == [f"{stranger}somebody"]


def test_two_participants_of_one_name_are_told_not_guessed(folder):
    made = term.load(folder / "course.toml")
    names = [f"Ana Kos_{n}_assignsubmission_file/x.ipynb" for n in (7, 8)]
    found = [Submission(name, "Ana Kos", folder, number=name[8]) for name in names]
    both = enrolment.joined(found, made.roster)
    assert all("participants 7, 8 are all called Ana Kos" in s.problem for s in both)
    assert len({s.student for s in both}) == 2 and not {s.student for s in both} & {"s1"}
    elsewhere = [Submission("kosana_1021_7_x.ipynb", "kosana", folder, number="1021"), found[0]]
    elsewhere.append(Submission("s1/x.ipynb", "s1", folder))
    assert [(s.student, s.problem) for s in enrolment.joined(elsewhere, made.roster)] == [
        ("s1", None)
    ] * 3


def test_a_release_is_as_moodle_and_canvas_take_it_in(folder):
    moodle = "Ana Kos_501_assignsubmission_file/x.ipynb"
    canvas = "ivoben_LATE_1022_7_x-1.ipynb"
    made, found = stored(
        folder, attempt("s1", 8, LATER, name=moodle), attempt("s2", 5.5, name=canvas)
    )
    made.keep_worksheet("99", folder / "sheet.csv", [])
    words = made.course, made.roster, "99", found["99"], made.worksheet("99")
    said = releases.release(*words)
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
    assert "handed in 2026-12-01 12:00 CET" in page
    with zipfile.ZipFile(out / "canvas-feedback.zip") as archive:
        assert archive.namelist() == ["ivoben_LATE_1022_7_exercise-99-feedback.html"]
    assert "in Moodle this assignment has 10 points, here 8" in "\n".join(said)
    text = (out / "feedback/s2.txt").read_text("utf-8")
    assert text.startswith("Exercise 99: A fake · Ben Ivo\n5.5 of 8 points\n")
    # again, after a change: what changed is told, and what was there is replaced whole
    (out / "stray").write_text("x")
    _, found = stored(folder, attempt("s2", 7, sha="d", name=canvas))
    said = releases.release(*words[:3], found["99"], words[4])
    assert said[-1] == "changed since the last release: Ben Ivo: 5.5 → 7"
    assert not (out / "stray").exists()


def test_who_handed_in_by_another_way_is_in_moodles_tables(folder):
    made, found = stored(folder, attempt("s2", 8, "2026-12-01T10:00:00+00:00", name="s2/x.ipynb"))
    made.keep_worksheet("99", folder / "sheet.csv", [])
    releases.release(made.course, made.roster, "99", found["99"], made.worksheet("99"))
    out = folder / "results/99/release"
    assert [row["Grade"] for row in table(out / "moodle.csv")] == ["", "8", ""]
    with zipfile.ZipFile(out / "moodle-feedback.zip") as archive:
        assert archive.namelist() == [
            "Ben Ivo_502_assignsubmission_file_/exercise-99-feedback.html"
        ]


def test_who_is_no_longer_in_the_roster_is_told(folder, capsys):
    stored(folder, attempt("old-id", 8))
    assert main(["grade", "release", "99"]) == 2
    assert "no longer in roster.csv, in submissions.csv only: old-id" in capsys.readouterr().err
    stored(folder, attempt("s1", 8))
    assert main(["grade", "release", "99"]) == 0
    assert "no longer in roster.csv" in capsys.readouterr().out
    assert {row["student"] for row in table(folder / "results/submissions.csv")} == {"s1", "old-id"}


def test_the_late_mark_of_canvas_is_told(folder):
    stored(folder, attempt("s2", 8, name="ivoben_LATE_1022_7_x.ipynb"))
    assert "late as Canvas says" in table(folder / "results/99/grades.csv")[1]["note"]


def test_a_students_id_names_his_page_whatever_it_holds():
    names = {releases.file_name(id) for id in ("s1", "../x", ".x", "a/b", "a%2fb", "š", "a b")}
    assert len(names) == 7
    assert all("/" not in name and not name.startswith(".") for name in names)


@pytest.mark.slow
def test_a_term_from_download_to_release_from_the_command_line(folder, capsys):
    with zipfile.ZipFile(folder / "download.zip", "w") as archive:
        archive.writestr("Ana Kos_501_assignsubmission_file/hw.ipynb", notebook(fake.SOLUTION))
        archive.writestr("Zed_509_assignsubmission_file/hw.ipynb", notebook(exercise="04"))
    words = ["grade", "download.zip", "--exercise", "99"]
    assert main([*words, "--worksheet", "sheet.csv"]) == 0
    said = capsys.readouterr().out
    assert "not in roster.csv, in submissions.csv only: Zed" in said
    assert "slamlab grade release 99" in said
    assert scores(folder) == {"s1": "6", "s2": "", "s3": ""}
    assert main(["grade", "adjust", "s1", "99-turn", "0.5", "--reason", "agreed"]) == 0
    assert scores(folder)["s1"] == "4.5"
    assert main(words) == 0  # the worksheet, the policy and the secret were kept
    assert scores(folder)["s1"] == "4.5"
    assert main(["grade", "release", "99", "--as", "Prof. X"]) == 0
    head = capsys.readouterr().out.strip().rsplit(" ", 1)[1]
    assert (folder / "results/99/release/moodle.csv").exists()
    with Gradebook(default_url(folder / "results")) as book:
        last = book.rows()[-1]
        assert (last["kind"], last["who"], last["hash"]) == ("release", "Prof. X", head)
    assert main(["grade", "verify", "--head", head]) == 0
    assert "1 of 1 scores proved" in capsys.readouterr().out
    assert main(["grade", "verify", "--head", "0" * 64]) == 1
    assert "cut off, or written anew" in capsys.readouterr().out
    assert main(["grade", "verify", "--head", "zzz"]) == 2
    assert "no head" in capsys.readouterr().err
    assert main(["grade", "adjust", "s1", "99-turn", "0.5", "--reason", " "]) == 2
    assert "--reason is empty" in capsys.readouterr().err
    capsys.readouterr()
    assert main(["grade", "forget", "ana kos"]) == 2
    assert "did you mean the id 's1'?" in capsys.readouterr().err
    assert main(["grade", "forget", "s1"]) == 0
    assert "roster.csv still names the student" in capsys.readouterr().out
    assert not list((folder / "results").rglob("feedback/s1.*"))
    sheet = (folder / "results/99/worksheet.csv").read_text("utf-8")
    assert "Participant 502" in sheet and "Ana Kos" not in sheet and "ana@uni.hr" not in sheet
    assert scores(folder)["s1"] == ""
    assert main(["grade", "verify", "--head", head]) == 0
    assert main(["grade", "forget", "s1"]) == 2
    assert main(words) == 0
    listed = table(folder / "results/submissions.csv")
    assert [row["student"] for row in listed] == ["s1", "not in the roster: Zed"]
    assert "04 by its metadata, 99 by --exercise" in listed[1]["note"]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["x", "--exercise", "04"], "the course file has no exercise 04; it has 99"),
        (["x", "--worksheet", "sheet.csv"], "--worksheet needs a course file, and --exercise"),
        (["x", "--course", "course.toml", "--out", "out"], "says what --out says"),
        (["x", "--policy", "p.toml"], "says what --policy says"),
        (["x", "--course", "no.toml"], "no.toml: No such file"),
        (["release", "04"], "the course file has no exercise 04"),
        (["release", "99"], "there is no gradebook"),
        (["likeness", "04"], "the course file has no exercise 04; it has 99"),
        (["adjust", "s2", "99-turn", "1", "--reason", "x"], "there is no gradebook"),
    ],
)
def test_wrong_use_in_a_term_is_told_in_one_line(folder, words, said, capsys):
    (folder / "x").mkdir()
    assert main(["grade", *words]) == 2
    error = capsys.readouterr().err
    assert said in error
    assert error.count("\n") == 1


def test_a_roster_that_is_not_there_yet_is_told_with_what_to_do(folder, capsys):
    (folder / "x").mkdir()
    (folder / "roster.csv").unlink()
    assert main(["grade", "x"]) == 2
    assert "roster.csv is not there: put your own table" in capsys.readouterr().err


def test_without_a_course_file_a_folder_for_the_results_is_asked_for(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["grade", "x"]) == 2
    assert "say --out DIR, or make a course file: slamlab grade init" in capsys.readouterr().err
    assert main(["grade", "release", "04"]) == 2
    assert "a release needs a course file" in capsys.readouterr().err
