"""A review in a real browser by keyboard alone; no code of a student runs in it."""

import asyncio
import json
from concurrent.futures import Future, ThreadPoolExecutor

import pytest

from classroom.exercises.verdict import LawResult, Verdict
from classroom.grading.gradebook import Gradebook, default_url
from classroom.grading.ledger import contents
from classroom.grading.records import Record
from classroom.grading.term import term
from classroom.reviewing import regrade_requests
from classroom.reviewing.class_state import ClassState
from classroom.reviewing.review_routes import serve
from tests.course.browser.watching import faults, fits, watch
from tests.timeouts import PATIENCE

pytestmark = pytest.mark.slow

ALONE = "def f(a, b):\n    c = a + b * 2\n    d = c - a / (b + 1)\n    return d * c + a - b"
EVIL = (
    "<img src=http://example.org/x onerror=\"document.title='run'\"><script>document.title='run'"
    "</script><svg onload=\"document.title='run'\"></svg><style>body{display:none}</style>"
)
COURSE = 'name = "SLAM"\ntime_zone = "UTC"\n[exercises.04]\n[exercises.06]\n'
ROSTER = f'id,name,section\ns1,"{EVIL.replace(chr(34), chr(34) * 2)}",A\ns2,Ben Ivo,B\ns3,Cy,B\n'


def record(student, exercise, points):
    law = LawResult(EVIL, EVIL, points, 3.5, int(points < 3.5), 20)
    task = {"04": "04-h-robot", "06": "06-update"}[exercise]
    verdict = Verdict(task, points, 3.5, (law,), hint=EVIL)
    cells = [[1, EVIL], [2, "import os  # \u202e"]] + [[3, ALONE + EVIL]] * (exercise == "04")
    data = contents.packed(json.dumps(cells).encode())
    name = contents.name_of(data)
    return Record(
        f"{student}-{exercise}{EVIL}.ipynb", student, exercise, verdicts=(verdict,),
        cells={2: f"PermissionError: {EVIL}"}, notes=(EVIL,), sha256=student * 8, seed="b" * 64,
        titles={task: EVIL}, kept={"cells": name}, contents={name: data}, signs=(EVIL,),
    )  # fmt: skip


@pytest.fixture
def state(tmp_path):
    """A class of which everybody writes HTML wherever something can be written."""
    (tmp_path / "course.toml").write_text(COURSE, "utf-8")
    (tmp_path / "roster.csv").write_text(ROSTER, "utf-8")
    made = term.load(tmp_path / "course.toml")
    made.course.results.mkdir()
    with Gradebook(default_url(made.course.results), "Tutor") as book:
        book.add_all([record("s1", "04", 1.0), record("s1", "06", 3.5), record("s2", "04", 2.0)])
        opened = ClassState(made, book)
        file = tmp_path / "requests.csv"
        file.write_text(f"student;exercise;request\ns2;04;'{EVIL.replace(chr(34), '')}\n", "utf-8")
        regrade_requests.take_regrade_requests(opened, file)
        yield opened


@pytest.fixture
def page(browser, state):
    """The page of that class; nothing goes wrong on it, and nothing else is loaded."""
    address, over, wrong = Future(), Future(), []

    async def serve_it():
        stop = asyncio.Event()
        over.set_result((asyncio.get_running_loop(), stop))
        await serve(state, started=address.set_result, ended=stop)

    with ThreadPoolExecutor(1) as thread:
        task = thread.submit(asyncio.run, serve_it())
        place = address.result(PATIENCE)
        context = browser.new_context(viewport={"width": 1300, "height": 900})
        try:
            opened = context.new_page()
            watch(opened, (place.split("#")[0],), wrong, wrong)
            opened.goto(place)
            opened.locator("td button").first.wait_for()
            yield opened
        finally:
            context.close()
            loop, stop = over.result(PATIENCE)
            loop.call_soon_threadsafe(stop.set)
            task.result(PATIENCE)
    # a change that is refused is no fault of the page, though the browser notes it
    assert [message for message in wrong if "409 (Conflict)" not in message] == []


def focused(page):
    return page.evaluate("document.activeElement.getAttribute('aria-label')")


def test_a_class_is_reviewed_by_keyboard_and_nothing_of_a_student_runs(page, state):
    assert page.url.endswith("/") and page.title() == "Review"
    page.keyboard.press("Tab")  # name, section, exercise, state, flagged, table
    assert page.evaluate("document.activeElement.id") == "who"
    for _ in range(4):
        page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.id") == "flagged"
    page.keyboard.press("Space")
    page.get_by_text("2 of 3 students, 3 cells").wait_for()
    page.locator("td button[tabindex='0']").focus()
    assert "04: 1, some points, flagged" in focused(page)
    for key, there in (("ArrowRight", "06: 3.5"), ("ArrowDown", "06: –"), ("ArrowLeft", "04: 2"),
                       ("Home", "04: 2"), ("ArrowUp", "04: 1")):  # fmt: skip
        page.keyboard.press(key)
        assert there in focused(page)
    page.keyboard.press("Enter")
    page.locator("#where", has_text="1 of 3").wait_for()
    page.keyboard.press("1")
    page.keyboard.type("2.5")
    page.keyboard.press("Tab")
    page.keyboard.type("why not")
    page.keyboard.press("Escape")  # what was typed is kept while another one is looked at
    for place in ("2 of 3", "3 of 3"):
        page.keyboard.press("j")
        page.locator("#where", has_text=place).wait_for()
    cells = page.locator("#code pre").all_text_contents()
    assert cells == [EVIL, "import os  # ⟦202e⟧", ALONE + EVIL]
    page.get_by_label("answer").fill("it is as it is")
    page.get_by_role("button", name="answer", exact=True).press("Enter")
    page.get_by_text("Regrade request, answered").wait_for()
    for place in ("2 of 3", "1 of 3"):
        page.keyboard.press("k")
        page.locator("#where", has_text=place).wait_for()
    page.keyboard.press("1")
    page.keyboard.press("Tab")
    page.keyboard.press("Enter")
    page.get_by_text("set by hand: why not").wait_for()
    page.keyboard.press("c")
    page.keyboard.type(EVIL)
    page.get_by_role("button", name="save comment").press("Enter")
    page.locator("#history", has_text="comment: <img").wait_for()
    page.keyboard.press("Escape")
    page.locator("td button[aria-label*='04: 2.5']").wait_for()
    assert "changed by hand" in focused(page)
    messages = [row["kind"] for row in state.book.rows()]
    assert messages[-3:] == ["answer", "override", "comment"]
    assert state.book.rows()[-1]["who"] == "Tutor"
    assert page.title() == "Review"
    assert page.evaluate("document.querySelectorAll('img, main script, main style').length") == 0


def keeps_nobody_out(page):
    for scheme in ("light", "dark"):
        page.emulate_media(color_scheme=scheme)
        for width in (1300, 390):
            page.set_viewport_size({"width": width, "height": 800})
            assert fits(page)
            assert faults(page) == []


def test_the_page_can_be_used_by_all(page):
    keeps_nobody_out(page)
    page.locator("td button").first.click()
    page.locator("#verdict .box").first.wait_for()
    keeps_nobody_out(page)
    page.get_by_role("button", name="table").click()
    page.locator("td button").first.wait_for()


def test_a_change_that_is_refused_keeps_what_was_typed(page, state):
    page.locator("td button").first.click()
    page.get_by_label("reason for the points of 04-h-robot").fill("my words")
    with Gradebook(default_url(state.term.course.results), "Another") as other:
        made = next(r for r in other.latest_attempts() if r.submission == f"s1-04{EVIL}.ipynb")
        other.override_points(made, "04-h-robot", 3, "other words")
    page.get_by_label("reason for the points of 04-h-robot").press("Enter")
    page.get_by_text("Not saved: Another has changed the submission").wait_for()
    page.get_by_text("set by hand: other words").wait_for()
    reason = page.get_by_label("reason for the points of 04-h-robot")
    assert reason.input_value() == "my words"
    reason.press("Enter")
    page.get_by_text("set by hand: my words").wait_for()


def test_two_similar_submissions_are_compared_by_keyboard_as_text(page, state):
    page.locator("#compare").press("Enter")
    page.get_by_text("Choose an exercise first").wait_for()
    page.keyboard.press("0")  # the field is the select now: 04
    page.locator("#compare").press("Enter")
    page.get_by_text("2 submissions compared").wait_for()
    assert "100 %" in page.evaluate("document.activeElement.textContent")
    page.keyboard.press("Enter")
    page.locator("#sides section").nth(1).wait_for()
    assert page.locator(".line.shared").first.text_content().startswith("<img src=")
    assert "  ≈ 3:1" in page.locator("#sides").text_content()
    keeps_nobody_out(page)
    page.get_by_label("Ben Ivo · B: show the submission and its verdict").press("Enter")
    page.locator("#title", has_text="Ben Ivo").wait_for()
    page.keyboard.press("Escape")
    page.locator("#compare").press("Enter")
    page.locator("#pairs button").first.wait_for()
    page.keyboard.press("Escape")
    assert page.locator("#class").is_visible() and page.title() == "Review"
    assert page.evaluate("document.querySelectorAll('img, main script, main style').length") == 0


HOLD = """() => {
  const fetched = window.fetch;
  let done;
  const let_go = new Promise((resolve) => { done = resolve; });
  window.fetch = async (...asked) => { await let_go; return fetched(...asked); };
  window.letGo = () => { window.fetch = fetched; done(); };
}"""
"""Holds what the page asks from now on; ``letGo()`` lets it go on."""


def test_a_late_answer_calls_nobody_back_who_has_gone_on(page):
    page.locator("td button").first.press("Enter")
    page.locator("#verdict .box").first.wait_for()
    drawn = page.locator("td").first.element_handle()
    page.evaluate(HOLD)
    page.keyboard.press("Escape")
    assert "04: 1, " in focused(page)  # at once, while the table is still on its way
    page.keyboard.press("ArrowDown")
    page.evaluate("letGo()")
    page.wait_for_function("old => !old.isConnected", arg=drawn)
    assert "04: 2, " in focused(page)
    page.keyboard.press("Enter")
    page.locator("#title", has_text="Ben Ivo").wait_for()
    drawn = page.locator("td").first.element_handle()
    page.evaluate(HOLD)
    page.keyboard.press("Escape")
    page.locator("#who").focus()
    page.evaluate("letGo()")
    page.wait_for_function("old => !old.isConnected", arg=drawn)
    assert page.evaluate("document.activeElement.id") == "who"


def test_a_pair_that_comes_late_calls_nobody_back_to_it(page):
    page.locator("#exercise").select_option(index=1)
    page.locator("#compare").press("Enter")
    page.locator("#pairs button").first.press("Enter")
    page.locator("#sides section").nth(1).wait_for()
    page.evaluate(HOLD)
    page.evaluate("void (late = tried(() => showPair(0)))")  # the key j, as if pressed once more
    page.keyboard.press("Escape")
    page.evaluate("letGo(), late")
    assert page.locator("#sides section").count() == 0
    assert "100 %" in page.evaluate("document.activeElement.textContent")


def test_what_is_typed_while_another_field_is_saved_goes_on(page):
    page.locator("td button").first.press("Enter")
    page.get_by_label("reason for the points of 04-h-robot").fill("my words")
    page.evaluate(HOLD)
    page.get_by_label("reason for the points of 04-h-robot").press("Enter")
    page.locator("#comment textarea").fill("half a")
    page.evaluate("letGo()")
    page.get_by_text("set by hand: my words").wait_for()
    page.keyboard.press("End")
    page.keyboard.type(" sentence")
    assert page.locator("#comment textarea").input_value() == "half a sentence"
