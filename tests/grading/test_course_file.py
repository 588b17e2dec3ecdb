"""The course file and the roster: what may stand there, and what is refused by name."""

import unicodedata
from datetime import UTC, datetime

import pytest

from slamlab.cli import main
from slamlab.grading.term import course_file, roster
from slamlab.grading.term.course_file import CourseFileError
from slamlab.grading.term.roster import RosterError
from slamlab.grading.term.worksheet import Worksheet

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


def test_a_time_without_a_zone_is_one_on_the_courses_clocks(tmp_path):
    made = course(tmp_path, "[exercises.99]\ndue = 2026-07-01T12:00:00\n[exercises.04]\n")
    assert made.due == {"99": datetime(2026, 7, 1, 10, tzinfo=UTC)}
    assert made.exercises == ("04", "99")
    made = course(tmp_path, "[exercises.99]\ndue = 2026-07-01")
    assert made.due["99"] == datetime(2026, 7, 1, 21, 59, 59, tzinfo=UTC)
    made = course(tmp_path, "[exercises.99]\ndue = 2026-07-01T12:00:00Z")
    assert made.due["99"] == datetime(2026, 7, 1, 12, tzinfo=UTC)


def test_places_are_seen_from_the_course_files_folder(tmp_path):
    made = course(tmp_path, 'results = "out"\n[exercises.99]')
    assert (made.results, made.secret) == (tmp_path / "out", tmp_path / "out" / "secret")
    assert course(tmp_path, 'secret = "/s"\n[exercises.99]').secret.as_posix() == "/s"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("rooster = 'x'\n[exercises.99]", "no setting rooster; there are name, time_zone, roster"),
        ("[exercises.98]", "no exercise '98'; there are 01, 02"),
        ("[exercises.4]", "no exercise '4'; there are 01, 02"),
        ("[exercises.99]\nDue = 2026-12-01", "no setting exercises.99.Due; there are due, canvas"),
        ("[exercises.99]\ndue = 5", "exercises.99.due is a time such as"),
        ("[exercises.99]\ndue = 12:00:00", "exercises.99.due is a time such as"),
        ("[exercises.99]\ncanvas = 5", "exercises.99.canvas is text"),
        ("[exercises]\n99 = 5", "exercises.99 is a table"),
        ("exercises = 5", "exercises is a table"),
        ("[[exercises.99]]", "exercises.99 is a table"),
        ("[exercises.99]\n[extensions]\n99 = 2026-12-01", "extensions.99 is a table of students"),
        ("[exercises.99]\ndue = 0226-12-01", "not 0226-12-01"),
        ("results = ''\n[exercises.99]", "results is the name of a file or folder"),
        ('secret = "a\\u0000"\n[exercises.99]', "secret holds a character"),
        ("", "say which exercises are graded"),
        ("roster = 5\n[exercises.99]", "roster is text in quotes"),
        ("[extensions.04]\na = 2026-12-01\n[exercises.99]", "no exercise '04'; there are 99"),
        ("[extensions.99]\na = 'soon'\n[exercises.99]", "extensions.99.a is a time"),
        ("attempts = 'first'\n[exercises.99]", "attempts is last or best, not 'first'"),
        ("isolation = 'high'\n[exercises.99]", "isolation is "),
        ("[late]\nper_week = 1\n[exercises.99]", "late: there is no setting 'per_week'"),
        ("[late]\ngrace_minutes = inf\n[exercises.99]", "late: grace_minutes is from 0"),
        ("[late", "course.toml: "),
    ],
)
def test_a_course_file_with_a_slip_is_refused_by_name(tmp_path, text, said):
    with pytest.raises(CourseFileError, match=said) as told:
        course(tmp_path, text)
    assert "course.toml" in str(told.value)
    assert "\n" not in str(told.value)


@pytest.mark.parametrize("zone", ["", "Europe/Nowhere", "../../etc/passwd", "/etc/passwd"])
def test_a_time_zone_that_does_not_exist_is_refused(tmp_path, zone):
    (tmp_path / "course.toml").write_text(f'time_zone = "{zone}"\n[exercises.99]')
    with pytest.raises(CourseFileError, match="time zone"):
        course_file.load(tmp_path / "course.toml")


def test_what_init_writes_is_a_course_file(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["grade", "init"]) == 0
    assert course_file.load(tmp_path / "course.toml").exercises[:2] == ("01", "02")
    assert main(["grade", "init"]) == 2
    assert "is there already" in capsys.readouterr().err


def test_a_roster_of_ones_own_has_extensions_in_columns(tmp_path):
    made = people(
        tmp_path, "id;name;email;99\ns1;Ana Kos;ana@uni.hr;2026-12-05 12:00\ns2;Ben Ivo;;\n"
    )
    assert list(made.students) == ["s1", "s2"]
    assert made.extensions == {("s1", "99"): datetime(2026, 12, 5, 11, tzinfo=UTC)}


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("id,name,sektion\ns1,Ana,A", "take out the column 'sektion': there are id, name, email"),
        ("id,name,98\ns1,Ana,", "take out the column '98'"),
        ("id,name,99\ns1,Ana,soon", "line 2: 99 is a time such as"),
        ("id,name\ns1,Ana\ns1,Ben", "line 3: the id s1 stands there twice"),
        ("id,name\n,Ana", "line 2: Ana has no id"),
        ("id,name\n", "names nobody"),
        ("who,what\n1,2", "must have the titles id and name"),
        ("id,name,name\n1,2,3", "a title stands there twice"),
        ("id,name,email\ns1,Kos, Ana,a@uni.hr", "line 2: more cells than titles"),
        ("id,name,section\ns1,Ana,A\ns1,Ana,B", "two sections has one line that names both"),
        ("", "must have the titles"),
    ],
)
def test_a_roster_with_a_slip_is_refused_by_name(tmp_path, text, said):
    with pytest.raises(RosterError, match=said):
        people(tmp_path, text)


def test_what_an_editor_puts_before_a_text_is_no_part_of_it(tmp_path):
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
    participants = people(
        tmp_path, "First name,Last name,ID number,Email address,Groups\nAna,Kos,s1,a@uni.hr,Mon\n"
    )
    assert participants.students["s1"].name == "Ana Kos"
    assert participants.students["s1"].section == "Mon"
    assert list(people(tmp_path, MOODLE).students) == ["s1", "ben@uni.hr", "s9"]


def test_a_worksheet_tells_whose_a_number_is_and_when_it_was_handed_in(tmp_path):
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


def test_a_time_in_a_worksheet_that_is_not_understood_is_told(tmp_path):
    (tmp_path / "sheet.csv").write_text(MOODLE.replace("December 2026", "prosinca 2026"), "utf-8")
    with pytest.raises(RosterError, match=r"sheet.csv, line 2: .*prosinca.* is no time"):
        Worksheet(tmp_path / "sheet.csv", UTC)


def test_what_is_no_worksheet_is_refused(tmp_path):
    (tmp_path / "sheet.csv").write_text("Identifier,Full name,Grade\nParticipant 1,Ana,")
    with pytest.raises(RosterError, match=r"no column 'Last modified \(grade\)'"):
        Worksheet(tmp_path / "sheet.csv", UTC)
