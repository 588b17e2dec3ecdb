"""Editing of cells during a lecture, and notebooks that are not lectures."""

import nbformat
import pytest
from nbformat import v4

from tests.course.browser.lecture import Lecture
from tests.course.browser.live import fresh

pytestmark = pytest.mark.slow

UNLOCKED = ".slamlab-unlocked"
SCALE = "Number(document.querySelector('.slamlab-deck .jp-WindowedPanel-viewport').style.zoom)"
NOTICE = "() => document.querySelector('.slamlab-notice').textContent"


def slide(cell, kind="slide"):
    cell.metadata["slideshow"] = {"slide_type": kind}
    return cell


def lecture(visit, lab_folder, *cells, has_slides=True):
    """A lecture on a notebook with these cells, just started."""
    made = lab_folder / "made_up.new"
    nbformat.write(fresh(*cells), made)
    made.replace(made.with_suffix(".ipynb"))  # the page before may still be saved into the old file
    visit.open("made_up.ipynb")
    shown = Lecture(visit)
    visit.page.locator(".slamlab-lecture-start").click()
    if has_slides:
        visit.page.wait_for_selector(".slamlab-deck .slamlab-bar")
    return shown


@pytest.fixture
def two_cells(visit, lab_folder):
    """A lecture whose one slide has two cells of code."""
    first, second = v4.new_code_cell("one = 1"), v4.new_code_cell("two = 2")
    return lecture(visit, lab_folder, slide(first), slide(second, "-"))


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
    shown.press("PageDown")
    shown.press("Control+Enter")
    page.get_by_text("begun", exact=True).wait_for()
    shown.press("s")
    page.locator(".slamlab-notice", has_text="stopped with an error").wait_for()
    shown.press("PageUp")
    first = page.locator(".jp-InputPrompt").first
    shown.press("R")
    page.locator(".slamlab-notice", has_text="again to restart").wait_for()
    assert first.text_content() == "[ ]:"
    shown.press("R")
    page.locator(".slamlab-notice", has_text="cells that follow").wait_for()
    assert first.text_content() == "[1]:"  # of a new kernel
    shown.press("s")
    page.locator(".slamlab-notice", has_text="stopped with an error").wait_for()
    assert shown.runs


def waiting_for(go):
    """Code that runs until a file is there."""
    return f"""
import os, time
while not os.path.exists({str(go)!r}):
    time.sleep(0.05)
print('done')"""


def test_running_is_shown_as_long_as_it_runs(visit, lab_folder):
    go = lab_folder / "go"
    shown = lecture(visit, lab_folder, slide(v4.new_code_cell(waiting_for(go))))
    shown.press("Control+Enter")
    visit.page.wait_for_timeout(4500)  # longer than other notices stay
    assert visit.page.evaluate(NOTICE) == "running …"
    busy = visit.page.locator(".slamlab-busy")
    busy.wait_for()  # whatever it was that made the kernel compute
    go.touch()
    visit.page.get_by_text("done", exact=True).wait_for()
    busy.wait_for(state="hidden")
    visit.page.wait_for_function(f"() => !({NOTICE})()")


def test_a_lecturer_who_goes_on_while_a_cell_runs_is_not_called_back(visit, lab_folder):
    go = lab_folder / "go_on"
    shown = lecture(visit, lab_folder, slide(v4.new_code_cell(waiting_for(go))))
    page = visit.page
    shown.press("e")
    shown.press("Control+Enter")
    button = page.get_by_role("button", name="Next (PageDown)")
    button.focus()
    go.touch()
    page.get_by_text("done", exact=True).wait_for()
    page.wait_for_function(f"() => !({NOTICE})()")
    assert button.evaluate("(one) => one === document.activeElement")


# JupyterLab saves by itself every two minutes: from now on they are short, and counted
AUTOSAVE = """async () => {
    const later = window.setTimeout;
    window.slamlabAutosaves = 0;
    window.setTimeout = (deed, wait, ...more) => wait === 120000
        ? later(() => { window.slamlabAutosaves += 1; deed(); }, 200) : later(deed, wait, ...more);
    for (let turn = 0; turn < 2; turn++) { // off and on, which sets the time anew
        await window.jupyterapp.commands.execute("docmanager:toggle-autosave");
    }
}"""


def test_autosave_calls_nobody_to_the_question_that_the_lecture_left(visit, lab_folder):
    shown = lecture(visit, lab_folder, slide(v4.new_code_cell("one = 1")))
    page = visit.page
    shown.press("e")
    page.keyboard.type("# changed ")
    shown.end()
    page.get_by_role("button", name="Restore it").wait_for()
    page.locator(".jp-CodeCell .cm-content").click()
    page.keyboard.type("typed ")
    page.evaluate(AUTOSAVE)
    page.wait_for_function("() => window.slamlabAutosaves > 2")
    page.keyboard.type("on ")
    assert "typed on" in page.locator(".jp-CodeCell .cm-content").inner_text()
    page.keyboard.press("Control+s")  # who saves is led to it
    keep = page.get_by_role("button", name="Keep the changes")
    page.keyboard.press("Tab")
    assert keep.evaluate("(one) => one === document.activeElement")
    keep.press("Enter")
    page.wait_for_function("() => !window.jupyterapp.shell.currentWidget.context.model.dirty")
    assert "typed on" in (lab_folder / "made_up.ipynb").read_text("utf-8")  # by itself, again


def test_a_slide_that_cannot_grow_reports_it(visit, lab_folder):
    full = "\n\n".join(f"line {k}" for k in range(30))
    shown = lecture(visit, lab_folder, *(slide(v4.new_markdown_cell(t)) for t in ("small", full)))

    def notice_after(key, way):
        before = visit.page.evaluate(SCALE)
        shown.press(key)
        reported = visit.page.evaluate(NOTICE)
        assert bool(reported) != (way * (visit.page.evaluate(SCALE) - before) > 0)
        return reported

    assert [notice_after("+", 1), notice_after("-", -1)] == ["", ""]
    shown.press("PageDown")
    steps = [notice_after("+", 1) for _ in range(9)]
    assert "This slide is full and does not grow. Other slides are larger now." in steps
    assert steps[-1] == "Slides cannot be larger."
    shown.press("0")
    assert visit.page.evaluate(NOTICE) == ""


def test_a_notebook_with_nothing_to_show_reports_it(visit, lab_folder):
    note = slide(v4.new_markdown_cell("Only for the speaker."), "notes")
    shown = lecture(visit, lab_folder, note, has_slides=False)
    reported = visit.page.get_by_role("alert").filter(has_text="nothing to show")
    reported.wait_for()
    assert not shown.runs
    reported.get_by_role("button", name="OK").click()
    assert reported.count() == 0
    assert visit.errors == []
