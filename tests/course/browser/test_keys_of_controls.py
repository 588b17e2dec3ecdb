"""Keys pressed on a control in an output reach the control, in a notebook and in a lecture."""

import nbformat
import pytest
from nbformat import v4

from tests.course.browser.lecture import Lecture
from tests.course.browser.live import fresh

pytestmark = pytest.mark.slow

CONTROLS = """\
import ipywidgets
list_ = ipywidgets.Dropdown(options=["line", "point", "corner"], description="method")
button = ipywidgets.Button(description="count")
said = ipywidgets.Label("0 times")
button.on_click(lambda _: setattr(said, "value", f"{int(said.value.split()[0]) + 1} times"))
slider = ipywidgets.IntSlider(5, 0, 10, description="turns", readout=False)
ipywidgets.VBox([list_, button, said, slider])"""
LIST, BUTTON, SLIDER = ".widget-dropdown select", ".jupyter-button", ".widget-slider .noUi-handle"
# what JupyterLab would do with a notebook's cells
EDITS = "x d d y m 1 a b z v c j k ArrowDown Shift+m Shift+v Control+Shift+ArrowDown"
CELLS = """() => {
    const { content } = window.jupyterapp.shell.currentWidget;
    const sources = content.widgets.map(({ model }) => [model.type, model.sharedModel.source]);
    return JSON.stringify([sources, content.activeCellIndex, content.mode]);
}"""


@pytest.fixture
def page(visit, lab_folder):
    """A notebook whose second cell has shown its controls."""
    cells = [v4.new_code_cell(source) for source in ("one = 1", CONTROLS, "two = 2")]
    for cell in cells[:2]:
        cell.metadata["slideshow"] = {"slide_type": "slide"}
    nbformat.write(fresh(*cells), lab_folder / "controls.ipynb")
    visit.open("controls.ipynb")
    visit.run(1)
    visit.page.locator(LIST).wait_for()
    return visit.page


@pytest.fixture(params=["notebook", "lecture"])
def place(request, page, visit):
    """The controls in a notebook, and on a slide."""
    if request.param == "lecture":
        lecture = Lecture(visit)
        lecture.start()
        lecture.go_on_to("a list", page.locator(LIST).is_visible)
    return page


def press(page, control, *keys):
    page.locator(control).focus()
    for key in keys:
        page.keyboard.press(key)


def test_controls_are_worked_by_their_keys(place):
    press(place, LIST, "ArrowDown", "ArrowDown", "ArrowUp")
    assert place.locator(LIST).evaluate("(one) => one.value") == "point"
    press(place, LIST, "c")  # by its first letter
    assert place.locator(LIST).evaluate("(one) => one.value") == "corner"
    press(place, SLIDER, "ArrowDown", "ArrowDown", "ArrowUp")
    assert place.locator(SLIDER).get_attribute("aria-valuenow") == "4.0"
    press(place, BUTTON, "Enter", "Space")
    place.get_by_text("2 times", exact=True).wait_for()


@pytest.mark.parametrize("control", [LIST, BUTTON, SLIDER])
def test_no_key_on_a_control_changes_the_cells_of_a_lecture(page, visit, control):
    Lecture(visit).start()
    page.keyboard.press("PageDown")
    before = page.evaluate(CELLS)
    for key in EDITS.split():
        press(page, control, key)
        assert page.evaluate(CELLS) == before, key


def test_on_a_slide_the_cell_whose_control_was_touched_is_run(page, visit):
    Lecture(visit).start()
    page.keyboard.press("PageDown")
    page.locator(BUTTON).click()
    page.get_by_text("1 times", exact=True).wait_for()
    page.keyboard.press("Control+Enter")
    page.get_by_text("0 times", exact=True).wait_for()
    assert page.locator(LIST).is_visible()  # the slide stays


def test_a_slide_s_keys_work_after_a_control_was_used(page, visit):
    lecture = Lecture(visit)
    lecture.start()
    lecture.press("PageDown")
    number = page.locator(".slamlab-number")
    for control in (SLIDER, BUTTON):
        press(page, control, "n")
        assert number.is_hidden(), "a letter is no key of it"
        press(page, control, "n")
        assert number.is_visible()
    page.locator(LIST).focus()
    page.mouse.click(640, 700)  # beside it
    lecture.press("n")
    assert number.is_hidden()
    lecture.press("n")


def test_a_key_that_no_control_uses_reaches_the_notebook(page, visit):
    press(page, LIST, "ArrowDown", "Control+s")
    visit.wait_until_clean()
