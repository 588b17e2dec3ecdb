"""Lecture mode in a real browser: keys do not edit, changes can be restored."""

import json
import random

import pytest

from tests.course.browser.lecture import Lecture

pytestmark = pytest.mark.slow

CODE = ".jp-CodeCell:not(.slamlab-off):not(.slamlab-later)"  # in sight
NAMES = """
    PageDown PageUp ArrowRight ArrowLeft ArrowUp ArrowDown Space Shift+Space . b o c n t + - 0 ? h
    F5 Shift+F5 Home End a m y x z d v s l p i j k Delete Backspace Enter Control+s Control+z
    Control+x Control+v Control+Enter Shift+Enter Alt+Enter Control+Shift+- Control+b Tab Escape
"""
KEYS = NAMES.split()

MONKEYS = [
    ("01_why_slam.ipynb", 17),
    pytest.param("05_localisation_and_mapping.ipynb", 5, marks=pytest.mark.walk),
    pytest.param("10_set_membership_slam.ipynb", 10, marks=pytest.mark.walk),
    pytest.param("16_your_own_slam.ipynb", 16, marks=pytest.mark.walk),
]

# a text on the second slide grows after the slide was laid out in advance
LAID_OUT_AHEAD = "() => jupyterapp.shell.currentWidget.slamlabDeck.layouts.has(1)"
GROW = """() => {
    const { notebook, slides } = jupyterapp.shell.currentWidget.slamlabDeck;
    const { node } = notebook.widgets[slides[1].cells[0]];
    const block = document.createElement("p");
    block.style.height = "420px";
    node.querySelector(".jp-RenderedMarkdown").append(block);
}"""


@pytest.fixture
def lecture(visit):
    """A lecture on the page of a visit, whose window has 720 lines."""
    visit.page.set_viewport_size({"width": 1280, "height": 720})
    return Lecture(visit)


def stored(lab_folder, lesson):
    return (lab_folder / lesson).read_bytes()


@pytest.mark.parametrize(("lesson", "seed"), MONKEYS)
def test_no_key_and_no_click_changes_the_file(lecture, lab_folder, lesson, seed):
    before = stored(lab_folder, lesson)
    lecture.visit.open(lesson)
    chance = random.Random(seed)
    width, height = 1280, 720
    for _ in range(2000):
        if not lecture.runs:
            lecture.start()
        if chance.random() < 0.8:
            lecture.page.keyboard.press(chance.choice(KEYS))
        else:
            click = chance.choice(["click", "dblclick"])
            buttons = ["left", "left", "right", "middle"] if click == "click" else ["left"]
            button = chance.choice(buttons)
            place = chance.randrange(width), chance.randrange(height)
            getattr(lecture.page.mouse, click)(*place, button=button)
        for other in lecture.page.context.pages[1:]:
            other.close()  # the presenter's window
    assert stored(lab_folder, lesson) == before
    sources = [cell["source"] for cell in json.loads(before)["cells"]]
    lecture.end_and_restore()
    lecture.visit.save()
    after = [cell["source"] for cell in json.loads(stored(lab_folder, lesson))["cells"]]
    assert after == sources


def test_what_is_unlocked_changed_and_run_is_restored(lecture, lab_folder):
    lesson = "07_correlations.ipynb"
    before = json.loads(stored(lab_folder, lesson))
    lecture.visit.open(lesson)
    lecture.start()
    lecture.go_on_to("code", lecture.page.locator(CODE).count)
    place, number = lecture.seen["stop"], lecture.number
    lecture.press("r")  # what the cell needs
    lecture.page.wait_for_function("() => !document.querySelector('.slamlab-notice').textContent")
    lecture.press("e")
    lecture.page.keyboard.press("Control+End")
    lecture.page.keyboard.type("\nprint('changed', 6 * 7)")
    lecture.press("Control+Enter")
    lecture.page.get_by_text("changed 42").wait_for()
    assert lecture.seen["stop"] == place
    lecture.press("Escape")  # locks the cell
    assert lecture.runs
    lecture.end()
    lecture.press("Control+s")
    assert json.loads(stored(lab_folder, lesson)) == before
    lecture.page.get_by_role("button", name="Restore it").click()
    assert lecture.page.get_by_text("changed 42").count() == 0
    lecture.page.locator(".slamlab-lecture-start").click()  # at the slide that was left
    lecture.page.wait_for_selector(".slamlab-deck .slamlab-bar")
    assert lecture.number == number
    lecture.end()
    lecture.visit.save()
    after = json.loads(stored(lab_folder, lesson))
    assert [(cell["source"], cell.get("outputs")) for cell in after["cells"]] == [
        (cell["source"], cell.get("outputs")) for cell in before["cells"]
    ]


def test_code_that_stops_with_an_error_is_reported_and_changes_can_be_kept(lecture, lab_folder):
    lesson = "02_sensors_and_worlds.ipynb"
    lecture.visit.open(lesson)
    lecture.start()
    lecture.go_on_to("code", lecture.page.locator(CODE).count)
    lecture.press("e")
    lecture.page.keyboard.press("Control+Home")
    lecture.page.keyboard.type("1 / 0 # kept\n")
    lecture.press("Control+Enter")
    lecture.page.locator(".slamlab-notice", has_text="stopped with an error").wait_for()
    lecture.end()
    lecture.page.get_by_role("button", name="Keep the changes").click()
    lecture.visit.save()
    assert b"# kept" in stored(lab_folder, lesson)


def test_remotes_and_the_keys_of_the_deck(lecture):
    lecture.visit.open("07_correlations.ipynb")
    lecture.start()
    for _ in range(5):
        lecture.press("PageDown")
    assert lecture.seen["stop"] == 5
    lecture.press("F5")  # from the beginning: the page is not reloaded
    assert lecture.seen["stop"] == 0
    layer = lecture.page.locator(".slamlab-layer")
    for key in (".", "b"):
        lecture.press(key)
        assert "slamlab-blank" in layer.get_attribute("class")
        lecture.press(key)
        assert "slamlab-blank" not in layer.get_attribute("class")
    lecture.press("o")
    cards = lecture.page.locator(".slamlab-overview button")
    assert f"/ {cards.count()}" in lecture.number
    assert cards.locator("> small:empty").count() == 0  # each has a picture or a text
    for digit in "17":
        lecture.press(digit)
    lecture.press("Enter")
    assert lecture.number.startswith("17 /")
    lecture.press("F5")
    lecture.press("o")
    lecture.press("ArrowRight")
    lecture.press("Enter")
    assert lecture.page.locator(".slamlab-overview").count() == 0
    assert lecture.page.locator(".slamlab-number").text_content().startswith("2 /")
    lecture.press("?")
    assert lecture.page.locator(".slamlab-help").get_by_text("black screen, and back").count() == 1
    lecture.press("Escape")
    assert lecture.runs
    for key, part in (("n", "number"), ("t", "timer")):
        hidden = lecture.page.locator(f".slamlab-{part}").is_hidden()
        lecture.press(key)
        assert lecture.page.locator(f".slamlab-{part}").is_hidden() != hidden
    lecture.press("Escape")
    assert not lecture.runs


def test_a_slide_that_was_laid_out_before_its_formulas_is_whole(lecture):
    lecture.visit.open("07_correlations.ipynb")
    lecture.start()
    lecture.page.wait_for_function(LAID_OUT_AHEAD)
    lecture.page.evaluate(GROW)
    lecture.go_on_to("the second slide", lambda: lecture.number.startswith("2 /"))
    assert not lecture.seen["cut"] and lecture.seen["shrink"] < 1


def test_a_lecture_starts_by_its_address(lecture):
    lecture.visit.address = lecture.visit.address.replace("?", "?lecture=1&")
    lecture.visit.open("07_correlations.ipynb")
    lecture.page.wait_for_selector(".slamlab-deck .slamlab-bar")
    assert lecture.seen["stop"] == 0
