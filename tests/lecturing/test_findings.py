"""What a rehearsal makes of cells and stops, without a browser."""

import io

import pytest
from rich.console import Console

from slamlab.lecturing.needs import needs
from slamlab.lecturing.planning import planned, total
from slamlab.lecturing.rehearsal import findings
from slamlab.lecturing.rehearsal_report import report
from slamlab.lecturing.shown_lesson import ShowError, lesson


def cell(id, slide, seconds=0.0, error=""):
    told = {"id": id, "type": "code", "code": "pass", "seconds": seconds, "error": error}
    return told | {"slide": slide, "title": "as its slide's"}


def stop(slide, title, minutes=0, letters=1.0, fits=True):
    told = {"slide": slide, "title": title, "id": "a", "minutes": minutes}
    return told | {"letters": letters, "fits": fits}


def told(rehearsed):
    """What the report says."""
    console = Console(file=io.StringIO(), width=120)
    report(rehearsed, console)
    return console.file.getvalue()


CELLS = [cell("a", 1, 0.5), cell("b", 1, 3.0), cell("c", 2, 0.1)]
FAILS = [*CELLS[:2], cell("c", 2, error="ValueError: no")]
STOPS = [stop(1, "Head", minutes=2), stop(2, "Two"), stop(2, "Two", minutes=5)]


def test_a_cells_time_counts_for_the_slide_it_stands_on_or_before():
    head, two = findings(CELLS, STOPS).sections
    assert (head.seconds, two.seconds) == (3.5, pytest.approx(0.1))
    assert len(head.slow) == 1 and not two.slow
    assert (head.minutes, two.minutes) == (2, 5)
    assert "Head: slide 1, cell b: 3.0 s" in told(findings(CELLS, STOPS))


def test_slow_is_not_wrong():
    assert findings(CELLS, STOPS, promised=7).is_sound


@pytest.mark.parametrize(
    ("cells", "stops", "more", "says"),
    [
        (FAILS, STOPS, {}, "Two: slide 2, cell c: ValueError: no"),
        (CELLS, [*STOPS, stop(2, "Two", letters=0.7)], {}, "letters of 70 %"),
        (CELLS, [*STOPS, stop(2, "Two", fits=False)], {}, "does not fit"),
        (CELLS, STOPS, {"promised": 8}, "planned for 7 minutes, its head says 8"),
        (CELLS, STOPS, {"errors": ["broken"]}, "the page says: broken"),
        (CELLS, STOPS, {"abroad": ["http://far"]}, "asks another machine: http://far"),
    ],
)
def test_what_is_wrong_is_said_and_makes_it_unsound(cells, stops, more, says):
    found = findings(cells, stops, **more)
    assert not found.is_sound and says in told(found)


def test_a_lesson_without_a_plan_has_its_minutes_spread():
    sections = [{"minutes": 0, "stops": stops} for stops in (3, 1, 2)]
    assert planned(sections, 12) == [6, 2, 4]
    assert sum(planned(sections, 100)) == 100
    assert planned(sections, None) == [0, 0, 0]
    assert total("text **100 minutes** (50 for)") == 100 and total("no") is None


def test_needs_are_found_where_a_name_is_used_not_where_it_is_imported(monkeypatch, tmp_path):
    monkeypatch.setenv("SLAMLAB_DATA", str(tmp_path))
    found = needs(
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
    assert lesson("7", tmp_path) == lesson("07", tmp_path) == lesson(str(file)) == file
    for word, says in (("8", "there are 07"), ("x.ipynb", "no such file")):
        with pytest.raises(ShowError, match=says):
            lesson(word, tmp_path)
