"""What a lecturer does to cells in front of the class, and notebooks that are no lecture."""

import nbformat
import pytest
from nbformat import v4

from tests.browser.lecture import Lecture

pytestmark = pytest.mark.slow

UNLOCKED = ".slamlab-unlocked"
NOTICE = "() => document.querySelector('.slamlab-notice').textContent"


def slide(cell, kind="slide"):
    cell.metadata["slideshow"] = {"slide_type": kind}
    return cell


def lecture(visit, lab_folder, *cells):
    """A lecture on a notebook with these cells, just started."""
    made = v4.new_notebook(cells=list(cells))
    made.metadata["kernelspec"] = {"name": "python3", "display_name": "Python 3"}
    nbformat.write(made, lab_folder / "made_up.ipynb")
    visit.open("made_up.ipynb")
    shown = Lecture(visit)
    visit.page.locator(".slamlab-lecture-start").click()
    return shown


@pytest.fixture
def two_cells(visit, lab_folder):
    """A lecture whose one slide has two cells of code."""
    first, second = v4.new_code_cell("one = 1"), v4.new_code_cell("two = 2")
    shown = lecture(visit, lab_folder, slide(first), slide(second, "-"))
    visit.page.wait_for_selector(".slamlab-deck .slamlab-bar")
    return shown


def touch(lecture, nth):
    """Press the mouse on a cell."""
    box = lecture.page.locator(".jp-CodeCell").nth(nth).bounding_box()
    lecture.page.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)


def test_a_cell_that_is_unlocked_locks_the_one_before(two_cells):
    page = two_cells.page
    for nth in (0, 1):
        touch(two_cells, nth)
        two_cells.press("e")
        assert page.locator(UNLOCKED).count() == 1
        assert "slamlab-unlocked" in page.locator(".jp-CodeCell").nth(nth).get_attribute("class")
        page.mouse.click(5, 5)
        page.evaluate("() => document.activeElement.blur()")
    two_cells.press("Escape")
    assert page.locator(UNLOCKED).count() == 0
    areas = page.locator(".jp-CodeCell .jp-InputArea")
    assert areas.evaluate_all("all => all.every((one) => one.inert)")
    assert two_cells.runs


def test_what_is_typed_after_a_run_is_the_cell_s(two_cells):
    page, editor = two_cells.page, two_cells.page.locator(f"{UNLOCKED} .cm-content")
    two_cells.press("e")
    for number in ("22", "33"):
        page.keyboard.press("Control+a")
        page.keyboard.type(f"two = {number}; print('is', two)")
        page.keyboard.press("Control+Enter")
        page.get_by_text(f"is {number}", exact=True).wait_for()
        page.keyboard.press("Shift+Home")  # no key of the deck
        assert editor.evaluate("(one) => one.contains(document.activeElement)")
    page.keyboard.press("Control+Enter")
    page.keyboard.type("#")  # while it runs
    page.wait_for_function(f"() => !({NOTICE})()")
    assert "#" in editor.inner_text()
    assert two_cells.seen["stop"] == 0


def test_a_cell_that_is_left_is_locked(visit, lab_folder):
    cells = [slide(v4.new_code_cell(text)) for text in ("one = 1", "two = 2")]
    shown = lecture(visit, lab_folder, *cells)
    visit.page.wait_for_selector(".slamlab-deck .slamlab-bar")
    shown.press("e")
    shown.press("PageDown")
    assert visit.page.locator(UNLOCKED).count() == 0
    shown.press("n")  # no letter of a cell
    assert visit.page.locator(".slamlab-number").is_hidden()
    shown.press("Escape")
    assert not shown.runs


def test_what_runs_is_stopped_and_a_kernel_restarted_without_leaving_the_slides(visit, lab_folder):
    codes = "one = 1", "import time\nprint('begun')\nwhile True:\n    time.sleep(0.01)"
    shown = lecture(visit, lab_folder, *(slide(v4.new_code_cell(code)) for code in codes))
    page = visit.page
    page.wait_for_selector(".slamlab-deck .slamlab-bar")
    shown.press("PageDown")
    shown.press("Control+Enter")
    page.get_by_text("begun", exact=True).wait_for()
    shown.press("s")
    page.locator(".slamlab-notice", has_text="stopped with an error").wait_for()
    shown.press("PageUp")
    first = page.locator(".jp-InputPrompt").first
    shown.press("R")
    page.locator(".slamlab-notice", has_text="once more").wait_for()
    assert first.text_content() == "[ ]:"
    shown.press("R")
    page.locator(".slamlab-notice", has_text="what follows").wait_for()
    assert first.text_content() == "[1]:"  # of a new kernel
    shown.press("s")
    page.locator(".slamlab-notice", has_text="stopped with an error").wait_for()
    assert shown.runs


def test_running_is_said_as_long_as_it_runs(visit, lab_folder):
    go = lab_folder / "go"
    code = f"""
import os, time
while not os.path.exists({str(go)!r}):
    time.sleep(0.05)
print('done')"""
    shown = lecture(visit, lab_folder, slide(v4.new_code_cell(code)))
    visit.page.wait_for_selector(".slamlab-deck .slamlab-bar")
    shown.press("Control+Enter")
    visit.page.wait_for_timeout(4500)  # longer than other notices stay
    assert visit.page.evaluate(NOTICE) == "running …"
    busy = visit.page.locator(".slamlab-busy")
    busy.wait_for()  # whatever it was that made the kernel compute
    go.touch()
    visit.page.get_by_text("done", exact=True).wait_for()
    busy.wait_for(state="hidden")
    visit.page.wait_for_function(f"() => !({NOTICE})()")


def test_a_notebook_with_nothing_to_show_says_so(visit, lab_folder):
    note = slide(v4.new_markdown_cell("Only for the speaker."), "notes")
    shown = lecture(visit, lab_folder, note)
    told = visit.page.get_by_role("alert").filter(has_text="nothing to show")
    told.wait_for()
    assert not shown.runs
    told.get_by_role("button", name="OK").click()
    assert told.count() == 0
    assert visit.errors == []
