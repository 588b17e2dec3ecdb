"""The course file and the roster: valid content, and errors that name what is invalid."""

import unicodedata
from datetime import UTC, datetime

import pytest

from classroom.grading.term import course_file, roster
from classroom.grading.term.course_file import CourseFileError
from classroom.grading.term.roster import RosterError
from classroom.grading.term.worksheet import Worksheet
from slamlab.cli import main

HEAD = 'time_zone = "Europe/Zagreb"\n'
MOODLE = """\ufeffIdentifier,Full name,ID number,Email address,Status,Grade,Maximum grade,\
Last modified (submission),Last modified (grade),Feedback comments
Participant 501,Ana Kos,s1,ana@uni.hr,,,8,"Tuesday, 1 December 2026, 11:10 PM",-,
Participant 502,Ben Ivo,,ben@uni.hr,,,8,"Wednesday, December 2, 2026, 9:00 AM",-,
Participant 503,Ben Ivo,s9,other@uni.hr,,,8,-,-,
"""
CANVAS = """Student,ID,SIS User ID,SIS Login ID,Section,A fake (4711),Final Score
    Points Possible,,,,,8,(read only)
"Kos, Ana",1021,s1,ana@uni.hr,Mon,,
"Ivo, Ben",1022,s2,ben@uni.hr,Tue,,
"Student, Test",1099,,x,Mon,,
"""


def course(tmp_path, text):
    (tmp_path / "course.toml").write_text(HEAD + text, "utf-8")
    return course_file.load(tmp_path / "course.toml")


def people(tmp_path, text):
    (tmp_path / "roster.csv").write_text(text, "utf-8")
    zone = course(tmp_path, "[exercises.99]").zone
    return roster.load(tmp_path / "roster.csv", ("99",), zone)


def test_a_time_without_a_zone_is_in_the_courses_zone(tmp_path):
    made = course(tmp_path, "[exercises.99]\ndue = 2026-07-01T12:00:00\n[exercises.04]\n")
    assert made.due == {"99": datetime(2026, 7, 1, 10, tzinfo=UTC)}
    assert made.exercises == ("04", "99")
    made = course(tmp_path, "[exercises.99]\ndue = 2026-07-01")
    assert made.due["99"] == datetime(2026, 7, 1, 21, 59, 59, tzinfo=UTC)
    made = course(tmp_path, "[exercises.99]\ndue = 2026-07-01T12:00:00Z")
    assert made.due["99"] == datetime(2026, 7, 1, 12, tzinfo=UTC)


def test_paths_are_relative_to_the_course_file(tmp_path):
    made = course(tmp_path, 'results = "out"\n[exercises.99]')
    assert (made.results, made.secret) == (tmp_path / "out", tmp_path / "out" / "secret")
    assert course(tmp_path, 'secret = "/s"\n[exercises.99]').secret.as_posix() == "/s"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("rooster = 'x'\n[exercises.99]", "rooster does not exist; the settings are name, time_"),
        ("[exercises.98]", "exercise '98' does not exist; the exercises are 01, 02"),
        ("[exercises.99]\nDue = 2026-12-01", "exercises.99.Due does not exist; the settings are"),
        ("[exercises.99]\ndue = 5", "exercises.99.due must be a time such as"),
        ("[exercises.99]\ncanvas = 5", "exercises.99.canvas must be a Canvas column"),
        ("[exercises]\n99 = 5", "exercises.99 must be a table"),
        ("exercises = 5", "exercises must be a table"),
        ("[exercises.99]\n[extensions]\n99 = 5", "extensions.99 must be a table of students"),
        ("[exercises.99]\ndue = 0226-12-01", "not 0226-12-01"),
        ("results = ''\n[exercises.99]", "results must be the name of a file or folder"),
        ('secret = "a\\u0000"\n[exercises.99]', "secret contains an unprintable character"),
        ("", "list the graded exercises"),
        ("roster = 5\n[exercises.99]", "roster must be text in quotes"),
        ("[extensions.04]\na = 5\n[exercises.99]", "'04' does not exist; the exercises are 99"),
        ("[extensions.99]\na = 'soon'\n[exercises.99]", "extensions.99.a must be a time"),
        ("attempts = 'first'\n[exercises.99]", "attempts must be last or best, not 'first'"),
        ("isolation = 'high'\n[exercises.99]", "isolation must be "),
        ("[late]\nper_week = 1\n[exercises.99]", "late: setting 'per_week' does not exist"),
        ("[late]\ngrace_minutes = inf\n[exercises.99]", "late: grace_minutes must be from 0"),
        ("[late", "course.toml: "),
    ],
)
def test_a_course_file_with_a_slip_is_refused_by_name(tmp_path, text, message):
    with pytest.raises(CourseFileError, match=message) as raised:
        course(tmp_path, text)
    assert "course.toml" in str(raised.value)
    assert "\n" not in str(raised.value)


def test_a_time_zone_that_does_not_exist_is_refused(tmp_path):
    for zone in ("", "Europe/Nowhere", "../../etc/passwd", "/etc/passwd"):
        (tmp_path / "course.toml").write_text(f'time_zone = "{zone}"\n[exercises.99]')
        with pytest.raises(CourseFileError, match="time zone"):
            course_file.load(tmp_path / "course.toml")


def test_init_writes_a_valid_course_file(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["grade", "init"]) == 0
    assert course_file.load(tmp_path / "course.toml").exercises[:2] == ("01", "02")
    assert main(["grade", "init"]) == 2
    assert "already exists" in capsys.readouterr().err


def test_an_own_roster_has_columns_of_extensions(tmp_path):
    lines = "id;name;email;99", "s1;Ana Kos;ana@uni.hr;2026-12-05 12:00", "s2;Ben Ivo;;"
    made = people(tmp_path, "\n".join(lines))
    assert list(made.students) == ["s1", "s2"]
    assert made.extensions == {("s1", "99"): datetime(2026, 12, 5, 11, tzinfo=UTC)}


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("id,name,sektion\n", "delete the column 'sektion'. Valid titles are id, name, email"),
        ("id,name,99\ns1,Ana,soon", "line 2: 99 must be a time such as"),
        ("id,name\ns1,Ana\ns1,Ben", "line 3: the id s1 occurs twice"),
        ("id,name\n,Ana", "line 2: Ana has no id"),
        ("id,name\n", "lists no students"),
        ("who,what\n1,2", "must have the titles id and name"),
        ("id,email\ns1,a@uni.hr", "must have the titles id and name"),
        ("id,name,name\n1,2,3", "a title occurs twice"),
        ("id,name,email\ns1,Kos, Ana,a@uni.hr", "line 2: there are more cells than titles"),
        ("id,name,section\ns1,Ana,A\ns1,Ana,B", "two sections, name both in one line"),
    ],
)
def test_a_roster_with_a_slip_is_refused_by_name(tmp_path, text, message):
    with pytest.raises(RosterError, match=message):
        people(tmp_path, text)


def test_a_byte_order_mark_is_ignored(tmp_path):
    (tmp_path / "course.toml").write_text(HEAD + "[exercises.99]", "utf-8-sig")
    assert course_file.load(tmp_path / "course.toml").exercises == ("99",)
    (tmp_path / "course.toml").write_text(HEAD + "[exercises.99]", "utf-16")
    with pytest.raises(CourseFileError, match="not UTF-8"):
        course_file.load(tmp_path / "course.toml")


@pytest.mark.parametrize(
    ("name", "in_moodle"),
    [
        ("Žiga Müller", unicodedata.normalize("NFD", "Žiga Müller")),
        (unicodedata.normalize("NFD", "Ana Šarić"), "Ana Šarić"),
        ("Ana O'Brien", "Ana OBrien"),
        ("Ben A/B Ivo", "Ben AB Ivo"),
        ("Eva Under_Score", "Eva Under Score"),
    ],
)
def test_a_name_is_found_as_moodle_and_the_system_write_it(tmp_path, name, in_moodle):
    made = people(tmp_path, f"id,name\ns1,{name}\ns2,Somebody Else\n")
    assert made.find(name=in_moodle).id == "s1"
    assert made.find(id=name) is None


def test_the_exports_of_moodle_and_canvas_are_rosters(tmp_path):
    canvas = people(tmp_path, CANVAS)
    assert [(s.id, s.name, s.canvas, s.section) for s in canvas.students.values()] == [
        ("s1", "Ana Kos", "1021", "Mon"),
        ("s2", "Ben Ivo", "1022", "Tue"),
    ]
    titles = "First name,Last name,ID number,Email address,Groups"
    ana = people(tmp_path, f"{titles}\nAna,Kos,s1,a@uni.hr,Mon\n").students["s1"]
    assert (ana.name, ana.section) == ("Ana Kos", "Mon")
    assert list(people(tmp_path, MOODLE).students) == ["s1", "ben@uni.hr", "s9"]


def test_a_worksheet_maps_a_number_to_its_student_and_submission_time(tmp_path):
    (tmp_path / "sheet.csv").write_text(MOODLE, "utf-8")
    own = people(tmp_path, "id,name,email\ns1,Ana K.,\ns2,Ben Ivo,ben@uni.hr\n")
    sheet = Worksheet(tmp_path / "sheet.csv", course(tmp_path, "[exercises.99]").zone)
    assert sheet.student("501", own).id == "s1"
    assert sheet.student("502", own).id == "s2"
    assert sheet.student("503", own) is None  # of the same name, with another ID number
    assert sheet.student("77", own) is None
    assert sheet.handed_in("501") == "2026-12-01T23:10:00+01:00"
    assert sheet.handed_in("502") == "2026-12-02T09:00:00+01:00"
    assert sheet.handed_in("503") is None


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (MOODLE.replace("December 2026", "prosinca 2026"),
         r"sheet.csv, line 2: .*prosinca.* is not in a known time format"),
        ("Identifier,Full name,Grade\nParticipant 1,Ana,",
         r"no column 'Last modified \(grade\)'"),
    ],
    ids=["a time that is not understood", "another table"],
)  # fmt: skip
def test_a_worksheet_that_cannot_be_used_is_refused(tmp_path, text, message):
    (tmp_path / "sheet.csv").write_text(text, "utf-8")
    with pytest.raises(RosterError, match=message):
        Worksheet(tmp_path / "sheet.csv", UTC)
