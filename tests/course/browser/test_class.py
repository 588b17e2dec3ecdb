"""A phone answers a question of lesson 00 in lecture mode."""

import pytest

from tests.course.browser.lecture import Lecture
from tests.timeouts import PATIENCE

pytestmark = pytest.mark.slow

QUESTION, OUTCOME, SECOND = "8", "9", "11"  # cells of lesson 00


@pytest.fixture
def lecture(visit):
    """A lecture on lesson 00, open to this machine alone."""
    visit.page.set_viewport_size({"width": 1280, "height": 720})
    visit.open("00_start_here.ipynb")
    visit.run_all_and_wait()
    shown = Lecture(visit)
    shown.start()
    shown.press("a")
    visit.page.get_by_role("button", name="open on this machine only").click()
    visit.page.locator(".slamlab-class-code").wait_for()
    yield shown
    shown.end()  # and the class, too


def join(page):
    """A phone whose owner has typed the address and the code."""
    phone = page.context.browser.new_context(viewport={"width": 390, "height": 780}).new_page()
    phone.set_default_timeout(1000 * PATIENCE)
    phone.goto(page.locator(".slamlab-class-address").inner_text())
    code = page.locator(".slamlab-class-code").inner_text()
    phone.get_by_label("Code on the lecturer's screen").fill(code)
    phone.keyboard.press("Enter")
    phone.get_by_text("Connected.").wait_for()
    return phone


def go_to(lecture, cell):
    lecture.go_on_to(f"cell {cell}", lambda: cell in lecture.seen["shown"].split("/")[0].split(","))


def test_a_phone_is_asked_before_the_outcome_is_shown(lecture):
    page = lecture.page
    phone = join(page)
    page.get_by_role("button", name="hide").click()
    go_to(lecture, QUESTION)
    with page.expect_popup() as opened:
        page.keyboard.press("p")
    presenter = opened.value
    presenter.get_by_text("Press q to ask the class.").wait_for()
    presenter.keyboard.press("q")
    phone.get_by_label("Your number [beams]").fill("398")
    phone.get_by_role("button", name="send").click()
    page.get_by_text("1 answer, 1 phone").wait_for()
    presenter.get_by_text("1 answer, 1 phone. Press q to close the poll").wait_for()
    page.get_by_role("button", name="show bars").click()
    page.locator(".slamlab-bars li", has_text="398").wait_for()
    seen = lecture.seen
    assert OUTCOME not in seen["shown"].split("/")[0].split(",") and not seen["cut"]
    page.get_by_role("button", name="close the poll").click()
    page.get_by_role("button", name="done").click()

    go_to(lecture, SECOND)
    page.get_by_role("button", name="ask the class").click()
    phone.locator(".choices button", has_text="stands behind something").click()
    page.get_by_text("1 answer, 1 phone").wait_for()
    assert lecture.visit.errors == lecture.visit.foreign_requests == []
