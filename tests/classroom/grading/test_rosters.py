"""Rosters: columns that are not read are refused, and everybody is found or named."""

import zipfile

import pytest

from classroom.grading.term.roster import RosterError
from classroom.grading.term.term import load
from slamlab.cli import main
from tests.classroom.grading import fake
from tests.classroom.grading.conftest import notebook
from tests.classroom.grading.term_folder import match_students

MOODLE = "First name,Last name,ID number,Email address{},Roles\n"
CANVAS = "Student,ID,SIS User ID,SIS Login ID,Section{}\n"


def write(folder, text):
    (folder / "roster.csv").write_text(text, "utf-8")


@pytest.mark.parametrize(
    "text",
    [
        MOODLE.format(",99") + "Ana,Kos,s1,ana@uni.hr,2026-12-05,Student\n",
        CANVAS.format(",99") + '"Kos, Ana",1021,s1,ana@uni.hr,Mon,2026-12-05\n',
    ],
    ids=["Moodle", "Canvas"],
)
def test_extensions_in_an_export_count(folder, text):
    write(folder, text)
    assert str(load(folder / "course.toml").policy.due_for("99", "s1").date()) == "2026-12-05"


@pytest.mark.parametrize("title", ["9", "ex99", "Exercise 99", "04"])
def test_a_column_that_looks_like_extensions_is_refused_by_name(folder, title):
    write(folder, MOODLE.format(f",{title}") + "Ana,Kos,s1,ana@uni.hr,2026-12-05,Student\n")
    with pytest.raises(RosterError, match=f"delete the column '{title}'. For extensions 99"):
        load(folder / "course.toml")


def test_teachers_are_no_students(folder):
    people = 'Ana,Kos,s1,,Student\nBo,Li,s2,,"Student, Teacher"\nPat,Prof,t1,,Non-editing teacher\n'
    write(folder, MOODLE.format("") + people)
    made = load(folder / "course.toml")
    assert list(made.roster.students) == ["s1", "s2"]
    assert made.warnings == ("roster.csv: Pat Prof is not a student (Non-editing teacher)",)


def test_a_family_name_that_comes_first_is_found_where_one_student_fits(folder):
    write(folder, "id,name\ns1,小明 王\ns2,Sinéad O'Brien\ns3,Jan Martin\ns4,Martin Jan\n")
    for name, student in {
        "王 小明": "s1",
        "O'Brien, Sinéad": "s2",
        "Martin Jan": "s4",  # the given order precedes
        "Jan Eva": "not in the roster: Jan Eva",
    }.items():
        assert match_students(folder, f"{name}/x.ipynb", sheet=False) == [student]


def test_a_canvas_download_without_user_numbers_in_the_roster_is_reported(folder, capsys):
    write(folder, "id,name\ns1,Ana Kos\n")
    with zipfile.ZipFile(folder / "download.zip", "w") as archive:
        archive.writestr("kosana_1021_7_x.ipynb", notebook(fake.SOLUTION))
    assert main(["grade", "download.zip", "--exercise", "99"]) == 0
    line = "files from Canvas that match no student: 1, because roster.csv has no user numbers"
    output = capsys.readouterr().out
    assert line in output and "slamlab grade release" not in output
    assert main(["grade", "release", "99"]) == 2
    assert line in capsys.readouterr().err


def test_a_worksheet_in_another_language_is_refused_with_the_remedy(folder, capsys):
    (folder / "sheet.csv").write_text("Kennung,Vollständiger Name,Bewertung\n", "utf-8")
    with zipfile.ZipFile(folder / "download.zip", "w") as archive:
        archive.writestr("Ana Kos_501_assignsubmission_file/x.ipynb", notebook())
    words = ["grade", "download.zip", "--exercise", "99", "--worksheet", "sheet.csv"]
    assert main(words) == 2
    assert "Download it with Moodle set to English" in capsys.readouterr().err
