"""What a rehearsal makes of cells and stops, without a browser."""

import io

import pytest
from rich.console import Console

from classroom.lecturing.lesson_page import LessonError, find_lesson
from classroom.lecturing.rehearsal import findings
from classroom.lecturing.rehearsal_report import report
from classroom.lecturing.requirements import requirements
from classroom.lecturing.time_plan import section_minutes, total_minutes


def cell(id, slide, seconds=0.0, error=""):
    stated = {"id": id, "type": "code", "code": "pass", "seconds": seconds, "error": error}
    return stated | {"slide": slide, "title": "as its slide's"}


def stop(slide, title, minutes=0, letters=1.0, fits=True, faults=()):
    stated = {"slide": slide, "title": title, "id": "a", "minutes": minutes}
    return stated | {"letters": letters, "fits": fits, "faults": faults}


def reported(rehearsed):
    """Return the text of the report."""
    console = Console(file=io.StringIO(), width=120)
    report(rehearsed, console)
    return console.file.getvalue()


CELLS = [cell("a", 1, 0.5), cell("b", 1, 3.0), cell("c", 2, 0.1)]
FAILS = [*CELLS[:2], cell("c", 2, error="ValueError: no")]
STOPS = [stop(1, "Head", minutes=2), stop(2, "Two"), stop(2, "Two", minutes=5)]


def test_the_time_of_a_cell_counts_for_its_slide():
    head, two = findings(CELLS, STOPS).sections
    assert (head.seconds, two.seconds) == (3.5, pytest.approx(0.1))
    assert len(head.slow) == 1 and not two.slow
    assert (head.minutes, two.minutes) == (2, 5)
    assert "Head: slide 1, cell b: 3.0 s" in reported(findings(CELLS, STOPS))
    assert findings(CELLS, STOPS, stated=7).is_sound, "a slow cell is not a problem"


@pytest.mark.parametrize(
    ("cells", "stops", "more", "message"),
    [
        (FAILS, STOPS, {}, "Two: slide 2, cell c: ValueError: no"),
        (CELLS, [*STOPS, stop(2, "Two", letters=0.7)], {}, "text size of 70 %"),
        (CELLS, [*STOPS, stop(2, "Two", fits=False)], {}, "does not fit"),
        (CELLS, [*STOPS, stop(2, "Two", faults=["is empty"])], {}, "slide 2, cell a: is empty"),
        (CELLS, STOPS, {"stated": 8}, "planned for 7 minutes, but its first cell states 8"),
        (CELLS, STOPS, {"errors": ["broken"]}, "error in the page: broken"),
        (CELLS, STOPS, {"external_requests": ["far"]}, "request to another machine: far"),
    ],
)
def test_problems_are_reported_and_fail_the_rehearsal(cells, stops, more, message):
    found = findings(cells, stops, **more)
    assert not found.is_sound and message in reported(found)


def test_minutes_are_distributed_in_a_lesson_without_a_plan():
    sections = [{"minutes": 0, "stops": stops} for stops in (3, 1, 2)]
    assert section_minutes(sections, 12) == [6, 2, 4]
    assert sum(section_minutes(sections, 100)) == 100
    assert section_minutes(sections, None) == [0, 0, 0]
    assert total_minutes("text **100 minutes** (50 for)") == 100 and total_minutes("no") is None


def test_requirements_are_found_where_a_name_is_used(monkeypatch, tmp_path):
    monkeypatch.setenv("SLAMLAB_DATA", str(tmp_path))
    found = requirements(
        [
            "import socket as s, os\nfrom slamlab import sources\nfrom slamlab.devices import Emir",
            "%matplotlib inline",
            "x = s.create_connection(y)",
            'log = sources.open("intel"); room = sources.open("sim:room")',
            'sources.open("devices:/dev/ttyUSB0,"); robot = Emir("/dev/rfcomm0")',
            'where = os.environ["SLAMLAB_DATA"]',
            "print(1)",
        ]
    )
    assert found[0] == found[1] == found[6] == []
    assert "a network (socket.create_connection)" in found[2]
    assert found[3] == ["the recording 'intel', which is not on this machine"]
    assert found[4] == ["a device (devices:/dev/ttyUSB0,)", "a device (slamlab.devices.Emir)"]
    assert found[5] == ["a recording (SLAMLAB_DATA)"]


def test_a_lesson_is_found_by_its_number_or_its_file(tmp_path):
    for folder in ("notebooks", "exercises"):
        (tmp_path / folder).mkdir()
    file = tmp_path / "notebooks" / "07_x.ipynb"
    file.touch()
    found = {find_lesson("7", tmp_path), find_lesson("07", tmp_path), find_lesson(str(file))}
    assert found == {file}
    for word, message in (("8", "The lessons are 07"), ("x.ipynb", "file not found")):
        with pytest.raises(LessonError, match=message):
            find_lesson(word, tmp_path)
