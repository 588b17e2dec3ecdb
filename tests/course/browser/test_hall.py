"""What goes wrong in front of a class: each is reported on the slides, which keep their keys."""

import os
import re
import signal
import socket

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_markdown_cell

from tests.course.browser.jupyter import Visit, jupyterlab
from tests.course.browser.lecture import Lecture
from tests.course.browser.live import fresh
from tests.course.browser.presenting import FIGURE

pytestmark = pytest.mark.walk  # minutes of a browser's time

SCREENS = {"720 lines": (1280, 720), "768 lines": (1024, 768), "150 %": (853, 480)}
SLIDES = [
    "import os\nprint('pid', os.getpid())",
    "x = 1",
    "print('x is', x)",
    "print('the', 'end')",
]
DIALOGS = ".jp-Dialog"
LONG = "A sentence beside the figure, which is long enough to fill many lines of a column. " * 9
WALK = """async () => {
    const { href } = document.querySelector('link[href$="lecture/lecture.css"]');
    const { walk } = await import(new URL("rehearsal.js", href));
    return walk(jupyterapp.shell.currentWidget);
}"""
INSIDE = """(one) => {
    const { left, right, top, bottom } = one.getBoundingClientRect();
    return one.scrollWidth <= one.clientWidth + 1 && one.scrollHeight <= one.clientHeight + 1
        && left >= 0 && right <= innerWidth && top >= 0 && bottom <= innerHeight;
}"""

ABOVE = """(one) => {
    const { left, top } = one.getBoundingClientRect();
    return document.elementFromPoint(left + 5, top + 5) === one;
}"""


def write(folder, name):
    """Write a notebook with a slide for each piece of code; return its name."""
    cells = [part for k, code in enumerate(SLIDES) for part in slide(k, code)]
    nbformat.write(fresh(*cells), folder / name)
    return name


def slide(number, code):
    kind = {"slideshow": {"slide_type": "slide"}}
    return new_markdown_cell(f"## Slide {number + 1}", metadata=kind), new_code_cell(code)


def begin(visit, name, run=True, size=(1280, 720)):
    """Open a notebook, run it, and show its slides."""
    visit.page.set_viewport_size(dict(zip(("width", "height"), size, strict=True)))
    visit.open(name)
    if run:
        visit.run_all_and_wait()
    shown = Lecture(visit)
    shown.start()
    return shown


@pytest.fixture
def lecture(visit, lab_folder, request):
    """A lecture on a notebook that was run."""
    return begin(visit, write(lab_folder, f"hall_{request.node.originalname}.ipynb"))


def trouble(page, words):
    page.locator(".slamlab-trouble", has_text=re.compile(words)).wait_for(state="attached")


def notice(page, words):
    page.locator(".slamlab-notice", has_text=re.compile(words)).wait_for(state="attached")


def kill_kernel(page):
    printed = page.locator(".jp-OutputArea-output", has_text="pid").text_content()
    os.kill(int(printed.split()[1]), signal.SIGKILL)


def has_its_keys(lecture):
    """Whether the overview opens and goes to a slide, and Escape closes what is open."""
    for key in "o3":
        lecture.press(key)
    lecture.press("Enter")
    assert lecture.number == "3 / 4" and not lecture.page.locator(DIALOGS).count()
    for key in ("?", "Escape", "PageUp"):
        lecture.press(key)
    assert lecture.number == "2 / 4" and lecture.runs
    return True


@pytest.mark.parametrize("size", SCREENS.values(), ids=SCREENS)
def test_a_kernel_that_dies_is_reported_above_everything(visit, lab_folder, size):
    lecture = begin(visit, write(lab_folder, f"hall_dies_{size[1]}.ipynb"), size=size)
    page = visit.page
    lecture.press("o")
    kill_kernel(page)
    trouble(page, "died .* Press R twice")
    message = page.locator(".slamlab-trouble")
    assert message.evaluate(INSIDE) and message.evaluate(ABOVE)
    lecture.press("o")
    assert has_its_keys(lecture)
    for key in "RR":
        lecture.press(key)
    trouble(page, "^$")
    page.get_by_text("the end", exact=True).wait_for(state="attached")
    assert lecture.number == "2 / 4"


def test_a_cell_that_ends_its_kernel_is_not_running_for_ever(lecture):
    page = lecture.page
    lecture.press("e")
    page.keyboard.press("Control+a")
    page.keyboard.type("import os; os._exit(1)")
    lecture.press("Control+Enter")
    trouble(page, "died")
    notice(page, "^$")
    lecture.press("Escape")
    assert has_its_keys(lecture)


def free_port():
    with socket.socket() as asked:
        asked.bind(("127.0.0.1", 0))
        return asked.getsockname()[1]


def test_a_server_that_stops_and_starts_again(browser, tmp_path):
    (tmp_path / "course" / "notebooks").mkdir(parents=True)
    name = write(tmp_path / "course" / "notebooks", "hall.ipynb")
    port, token = free_port(), {"JUPYTER_TOKEN": "a" * 32}
    page = browser.new_page()
    with jupyterlab(tmp_path, port, **token) as address:
        lecture = begin(Visit(page, address), name)
    trouble(page, "server does not answer")
    lecture.press("Control+Enter")
    notice(page, "^$")  # nothing runs, and the output remains
    page.locator(".jp-OutputArea-output", has_text="pid").wait_for()
    page.wait_for_timeout(8000)  # JupyterLab reports it, too, after a while
    assert has_its_keys(lecture)
    with jupyterlab(tmp_path, port, **token):
        page.locator(".slamlab-trouble", has_text="server does not").wait_for(state="detached")
        for key in "RR":
            lecture.press(key)
        trouble(page, "^$")
        page.get_by_text("x is 1", exact=True).wait_for(state="attached")
        assert has_its_keys(lecture)
    page.close()


def test_a_broken_cell_is_named_reached_and_restored(lecture):
    page = lecture.page
    lecture.press("PageDown")
    lecture.press("e")
    page.keyboard.press("Control+a")
    page.keyboard.type("x = 1 / 0")
    lecture.press("Control+Enter")
    notice(page, "stopped with an error: ZeroDivisionError")
    lecture.press("Escape")
    for key in ("PageDown", "R", "R"):
        lecture.press(key)
    notice(page, "Slide 2 stopped with an error: ZeroDivisionError.* Press g .* or u")
    lecture.press("g")
    assert lecture.number == "2 / 4"
    lecture.press("PageDown")
    lecture.press("u")
    notice(page, "restored")
    lecture.press("r")
    page.get_by_text("x is 1", exact=True).wait_for()
    assert lecture.number == "3 / 4"


@pytest.mark.parametrize("size", SCREENS.values(), ids=SCREENS)
def test_a_lecture_before_all_cells_ran_reports_it(visit, lab_folder, size):
    name = write(lab_folder, f"hall_before_{size[1]}.ipynb")
    lecture = begin(visit, name, run=False, size=size)
    page = visit.page
    trouble(page, "No cell has run .* Press r ")
    assert page.locator(".slamlab-trouble").evaluate(INSIDE)
    for _ in range(2):
        lecture.press("PageDown")
    lecture.press("Control+Enter")
    notice(page, "NameError: .* Press r ")
    lecture.press("r")
    page.get_by_text("x is 1", exact=True).wait_for()
    lecture.press("?")
    assert page.locator(".slamlab-help").evaluate(INSIDE)
    assert [page.locator(".slamlab-trouble").text_content(), visit.errors] == ["", []]


def test_the_address_starts_its_lesson_whatever_tabs_are_restored(visit, lab_folder):
    names = [write(lab_folder, f"hall_tab_{k}.ipynb") for k in range(3)]
    visit.open(names[0])
    for name in names[1:]:
        path = f"notebooks/{name}"
        visit.page.evaluate(
            "(path) => jupyterapp.commands.execute('docmanager:open', { path })", path
        )
    visit.page.wait_for_function("() => [...jupyterapp.shell.widgets('main')].length == 3")
    visit.page.wait_for_timeout(2000)  # JupyterLab writes its layout
    for name in (names[1], names[0]):
        address = visit.address.format(f"notebooks/{name}")
        visit.page.goto(address.replace("?reset&", "?lecture=1&"))
        visit.page.wait_for_selector(".slamlab-deck .slamlab-bar")
        shown = "() => jupyterapp.shell.currentWidget.context.path"
        assert visit.page.evaluate(shown).endswith(name)
        lecture = Lecture(visit)
        assert has_its_keys(lecture)
        lecture.end()
        lecture.start()
        assert has_its_keys(lecture)


def test_two_windows_of_a_lesson_do_not_pull_each_other_back(lecture, lab):
    other = Lecture(Visit(lecture.page.context.new_page(), lab))
    name = lecture.page.evaluate("() => jupyterapp.shell.currentWidget.context.path")
    other.visit.open(name)
    other.page.locator(".slamlab-lecture-start").click()
    other.page.get_by_role("alert").filter(has_text="another window").wait_for()
    assert not other.runs and has_its_keys(lecture)
    other.page.keyboard.press("Enter")  # Show them here
    other.page.wait_for_selector(".slamlab-deck .slamlab-bar")
    assert has_its_keys(other)
    lecture.page.get_by_role("alert").filter(has_text="another window").wait_for()
    assert not lecture.runs


def test_the_right_answer_and_its_reason_are_shown(visit, lab_folder):
    question = slide(0, "from classroom.checks import ask\nask('11-few')")
    nbformat.write(fresh(*question), lab_folder / "hall_answers.ipynb")
    lecture = begin(visit, "hall_answers.ipynb")
    with visit.page.expect_popup() as opened:
        visit.page.keyboard.press("p")
    answer = "The answer is C: each resampling changes"
    opened.value.locator("#questions .answer", has_text=answer).wait_for()
    visit.page.bring_to_front()
    visit.page.get_by_role("button", name="show me").click()
    visit.page.locator(".jp-OutputArea-output", has_text=answer).wait_for()
    assert lecture.runs


def test_no_slide_is_a_line_of_code_and_nothing_later_is_left_of_earlier(visit, lab_folder):
    """A folded function, a heading alone, and a figure with text beside it."""
    function = "def f(x):\n" + "    x = x + 1\n" * 9 + "    return x"
    figure = "from IPython.display import HTML\nHTML(" + repr(FIGURE) + ")"
    kinds = ("slide", "subslide", "slide", "fragment", "subslide", "fragment", "fragment")
    texts = "## A heading", "Text of the section.", LONG, LONG
    cells = [new_markdown_cell("## First"), new_code_cell(function), new_markdown_cell(texts[0])]
    cells += [
        new_markdown_cell(texts[1]),
        new_code_cell(figure),
        *map(new_markdown_cell, texts[2:]),
    ]
    for cell, kind in zip(cells, kinds, strict=True):
        cell.metadata["slideshow"] = {"slide_type": kind}
    cells.insert(
        2, new_markdown_cell("Uses it.", metadata={"slideshow": {"slide_type": "subslide"}})
    )
    nbformat.write(fresh(*cells), lab_folder / "hall_slides.ipynb")
    lecture = begin(visit, "hall_slides.ipynb")
    lecture.press("PageDown")
    visit.page.get_by_role("paragraph").filter(has_text="Uses it.").wait_for()
    assert lecture.number == "2 / 4" and len(lecture.seen["telling"]) == 1
    lecture.press("PageDown")
    visit.page.get_by_role("paragraph").filter(
        has_text="Text of the"
    ).wait_for()  # with its heading
    lecture.press("PageDown")
    faults = visit.page.evaluate(WALK)
    assert [stop["faults"] for stop in faults if stop["faults"]] == []
    boxes = "all => all.map((one) => one.getBoundingClientRect().left)"
    left = visit.page.locator(".slamlab-deck .jp-Cell:not(.slamlab-off)").evaluate_all(boxes)
    assert left == sorted(left)


def test_printed_columns_are_whole_or_reported(visit, lab_folder):
    lines = "print('x  ' * 30)", "print('x  ' * 50)", "print('word ' * 50)"  # the last is prose
    cells = [part for k, code in enumerate(lines) for part in slide(k, code)]
    nbformat.write(fresh(*cells), lab_folder / "hall_printed.ipynb")
    begin(visit, "hall_printed.ipynb")
    faults = [stop["faults"] for stop in visit.page.evaluate(WALK)]
    assert faults == [[], ["breaks a printed line"], []]


def test_a_lecture_whose_notebook_is_closed_gives_back_the_keys(lecture):
    lecture.page.evaluate("() => { jupyterapp.shell.currentWidget.dispose(); }")
    lecture.page.wait_for_selector(".slamlab-deck", state="detached")
    suppressed = "() => document.body.dataset.lmSuppressShortcuts ?? ''"
    assert lecture.page.evaluate(suppressed) == ""
