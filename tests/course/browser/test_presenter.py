"""Presenter's window: synchronised with the deck, also after a window was closed and reopened."""

import os
import re
import signal

import numpy as np
import pytest

from tests.course.browser.jupyter import Visit
from tests.course.browser.presenting import SLIDES, Lecture
from tests.course.browser.watching import faults
from tests.timeouts import until

pytestmark = pytest.mark.walk  # minutes of a browser's time

STOPS = 9  # of the notebook: two, two, three, one, one


@pytest.fixture
def lecture(visit, lab_folder, request):
    """A lecture that has begun."""
    shown = Lecture(visit, lab_folder, f"presented_{request.node.name}")
    shown.begin()
    yield shown
    assert visit.foreign_requests == []


def stands_at(presenter, stop):
    presenter.locator(f"body[data-deck=here][data-at='{stop}']").wait_for()


def report(presenter, words):
    presenter.locator("#message", has_text=re.compile(words)).wait_for(state="attached")


def test_both_windows_name_the_same_slide_after_each_of_500_steps_of_either(lecture):
    presenter = lecture.presenter()
    rng = np.random.default_rng(5)
    at = 0
    slides = set()
    for step in range(500):
        window = (lecture.page, presenter)[step % 2]
        key, move = [("PageDown", 1), ("PageDown", 1), ("PageUp", -1)][rng.integers(3)]
        at = min(max(at + move, 0), STOPS - 1)
        if at == STOPS - 1 and rng.random() < 0.5:
            key, at = "F5", 0  # from the beginning: no window may reload
        window.keyboard.press(key)
        stands_at(presenter, at)
        assert presenter.locator("#place").text_content().startswith(lecture.number), step
        slides.add(lecture.number)
    assert len(slides) == SLIDES
    assert lecture.visit.errors == []


def test_it_shows_notes_with_formulas_this_slide_the_next_one_and_what_to_ask(lecture):
    presenter = lecture.presenter()
    presenter.locator("#notes mjx-container").wait_for()
    fonts = "[...document.fonts].filter((font) => font.family.includes('MJX')).length"
    assert presenter.evaluate(fonts), "formulas of the notes have no letters of their own"
    now, then = (presenter.frame_locator(f"#{name} iframe") for name in ("present", "next"))
    now.locator("p", has_text="What it is about.").wait_for()
    assert now.locator("p", has_text="And a fragment.").is_hidden()
    then.locator("p", has_text="And a fragment.").wait_for()
    presenter.keyboard.press("PageDown")
    now.locator("p", has_text="And a fragment.").wait_for()
    then.get_by_role("heading", name="Moving").wait_for()
    for _ in range(3):
        presenter.keyboard.press("PageDown")
    presenter.locator("#questions", has_text="How many walls?").wait_for()
    presenter.locator("#questions .where", has_text="on slide 4").wait_for()
    now.locator("p", has_text="one").wait_for()
    assert now.locator("b", has_text="two").is_hidden()  # a step is revealed by itself
    then.locator("b", has_text="two").wait_for()
    presenter.get_by_label("Go to a slide").select_option("4")
    presenter.locator("#next", has_text="This is the last slide.").wait_for()
    assert lecture.number == "5 / 5"
    presenter.locator("button[data-key='.']").click()
    report(presenter, "screen is black")
    lecture.page.locator(".slamlab-blank").wait_for()


def test_a_canvas_is_shown_as_it_was_drawn(lecture):
    presenter = lecture.presenter()
    source = presenter.evaluate(
        """async () => {
            const { copied } = await import("./slide_snapshot.js");
            const cell = document.createElement("div"), canvas = document.createElement("canvas");
            canvas.getContext("2d").fillRect(0, 0, 9, 9);
            cell.append(canvas);
            return [copied(cell).querySelector("img").src, canvas.toDataURL()];
        }"""
    )
    assert source[0] == source[1]


def test_it_has_an_address_without_a_token_names_and_no_fault_of_accessibility(lecture):
    presenter = lecture.presenter()
    presenter.locator("#notes mjx-container").wait_for()
    assert "token=" not in presenter.url
    assert faults(presenter) == []
    presenter.keyboard.press("Tab")
    outline = "getComputedStyle(document.activeElement).outlineStyle"
    assert presenter.evaluate(outline) == "solid"


def test_minutes_of_sections_are_planned_and_what_is_late_is_reported(lecture):
    presenter = lecture.presenter()
    presenter.locator("#plan", has_text="section 0–5 of 17 min").wait_for()
    message = presenter.evaluate(
        """async () => {
            const { planAt } = await import("./timing.js");
            const slides = [{ minutes: 5 }, { minutes: 10 }, {}, { minutes: 2 }];
            return [planAt(slides, 2, 9), planAt(slides, 2, 18.5), planAt(slides, 3, 9),
                planAt([{}], 0, 1), planAt([{}, { minutes: 3 }], 0, 1)];
        }"""
    )
    assert message == [
        "section 5–15 of 17 min",
        "section 5–15 of 17 min, 3 min behind",
        "section 15–17 of 17 min, 6 min ahead",
        "no minutes are planned",
        "3 min planned",
    ]
    lecture.press("End")
    stands_at(presenter, STOPS - 1)
    presenter.get_by_role("button", name="set the timer").click()
    presenter.locator("#elapsed", has_text=re.compile("^15:")).wait_for()
    presenter.locator("#plan", has_text=re.compile("^section 15–17 of 17 min$")).wait_for()
    lecture.press("t")  # there is one timer, which the presenter window only shows
    lecture.page.locator(".slamlab-timer:visible", has_text=re.compile("^15:")).wait_for()
    presenter.close()
    until(lambda: len(lecture.page.context.pages) == 1)
    presenter = lecture.presenter()
    presenter.locator("#elapsed", has_text=re.compile("^15:")).wait_for()
    lecture.press("Home")
    stands_at(presenter, 0)
    presenter.get_by_role("button", name="set the timer").click()
    presenter.locator("#elapsed", has_text=re.compile("^0:")).wait_for()


def test_either_window_may_be_loaded_again_and_the_lecture_goes_on(lecture):
    presenter = lecture.presenter()
    lecture.press("PageDown", "PageDown")
    stands_at(presenter, 2)
    presenter.reload()
    stands_at(presenter, 2)
    presenter.locator("body[data-drawn='2']").wait_for()

    lecture.page.reload()
    report(presenter, "have ended")
    lecture.page.locator(".jp-NotebookPanel .jp-Cell").first.wait_for()
    lecture.start()
    stands_at(presenter, 0)
    report(presenter, "^$")
    presenter.get_by_role("button", name="continue at slide 2").click()
    stands_at(presenter, 2)
    lecture.press("Escape")
    report(presenter, "have ended")
    lecture.start()
    stands_at(presenter, 2)
    presenter.keyboard.press("PageUp")
    stands_at(presenter, 1)


def test_a_kernel_that_dies_is_reported_and_the_slides_go_on(visit, lab_folder):
    lecture = Lecture(visit, lab_folder, "presented_killed")
    lecture.begin(run=True)
    presenter = lecture.presenter()
    lecture.press("PageDown", "PageDown")
    printed = lecture.page.locator(".jp-OutputArea-output", has_text="pid")
    os.kill(int(printed.text_content().split()[1]), signal.SIGKILL)
    report(presenter, "died .* Press R twice")
    presenter.keyboard.press("PageDown")
    stands_at(presenter, 3)
    presenter.keyboard.press("r")
    report(presenter, "^$")
    presenter.keyboard.press("PageDown")
    stands_at(presenter, 4)


def test_where_no_window_opens_by_a_key_a_link_is_offered(lecture):
    lecture.page.evaluate("window.open = () => null")
    lecture.press("p")
    link = lecture.page.get_by_role("link", name="Open the presenter window")
    with lecture.page.expect_popup() as opened:
        link.click()
    stands_at(opened.value, 0)


def test_two_lectures_are_not_mixed_up(lecture, lab_folder, lab):
    presenter = lecture.presenter()
    other = Lecture(Visit(lecture.page.context.new_page(), lab), lab_folder, "presented_too")
    other.begin()
    second = other.presenter()
    other.press("PageDown", "PageDown")
    stands_at(second, 2)
    lecture.press("PageDown")
    stands_at(presenter, 1)
    stands_at(second, 2)
