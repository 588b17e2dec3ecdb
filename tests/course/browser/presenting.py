"""A notebook for a lecture, with the deck and the presenter's window."""

import nbformat
from nbformat.v4 import new_code_cell, new_markdown_cell, new_output

from tests.course.browser.live import fresh

FIGURE = (
    "<img class='slamlab-figure' width='480' height='240' alt='a square' src='data:image/svg+xml,"
    "%3Csvg xmlns=%22http://www.w3.org/2000/svg%22 width=%22480%22 height=%22240%22%3E"
    "%3Crect width=%22480%22 height=%22240%22 fill=%22white%22 stroke=%22black%22/%3E%3C/svg%3E'>"
)
LIVE = f"""\
import os
import ipywidgets
from IPython.display import HTML, display
slider = ipywidgets.IntSlider(description="turns", max=100)
said = ipywidgets.Label("at 0")
slider.observe(lambda change: setattr(said, "value", f"at {{change['new']}}"), "value")
display(slider, said, HTML({FIGURE!r}))
print("pid", os.getpid())"""
STEPS = '<p>one <b class="slamlab-step">two</b> <b class="slamlab-step">three</b></p>'
SLIDES = 5
START = ".slamlab-lecture-start"


def _cell(cell, kind=None, **metadata):
    if kind:
        cell.metadata["slideshow"] = {"slide_type": kind}
    if metadata:
        cell.metadata["slamlab"] = metadata
    return cell


def _shows(source, **data):
    data = {name.replace("_", "/"): text for name, text in data.items()}
    return new_code_cell(source, outputs=[new_output("display_data", data)], execution_count=1)


def notebook():
    """Five slides with fragments, steps, notes, a question, a slider and a figure.

    Returns
    -------
    NotebookNode
    """
    steps = _shows("show_steps = 1", text_html=STEPS, text_plain="one two three")
    asked = _shows("# ask('how many')", text_markdown="**How many** walls?", text_plain="walls?")
    made = fresh(
        _cell(new_markdown_cell("# A lecture\n\nWhat it is about."), "slide", minutes=5),
        _cell(new_markdown_cell("Say that $x^2 + y^2$ is a square."), "notes"),
        _cell(new_markdown_cell("And a fragment."), "fragment"),
        _cell(new_markdown_cell("## Moving"), "slide", minutes=10),
        new_code_cell(LIVE),
        _cell(new_markdown_cell("Seen?"), "fragment"),
        _cell(new_markdown_cell("## Steps"), "slide"),
        steps,
        _cell(new_markdown_cell("## A question"), "slide"),
        asked,
        _cell(new_markdown_cell("## The end"), "slide", minutes=2),
    )
    for number, cell in enumerate(made.cells):
        cell.id = f"cell-{number}"
    return made


class Lecture:
    """A lecture on a notebook of its own.

    Parameters
    ----------
    visit : Visit
    folder : Path, where notebooks are
    name : str, of the notebook, without its ending
    """

    def __init__(self, visit, folder, name):
        self.visit, self.page = visit, visit.page
        self.file = folder / f"{name}.ipynb"
        nbformat.write(notebook(), self.file)

    def begin(self, run=False):
        """Open the notebook and show its slides from the first on."""
        self.visit.open(self.file.name)
        if run:
            self.visit.run_all_and_wait()
            self.page.locator(".widget-label", has_text="at 0").wait_for()
            self.visit.save()
            self.page.locator(".jp-Cell").first.click()
        self.start()

    def start(self):
        """Show the slides."""
        self.page.locator(START).click()
        self.page.locator(".slamlab-number").wait_for()

    def presenter(self):
        """Open the presenter window by its key, and wait until it shows the slide."""
        with self.page.expect_popup() as opened:
            self.page.keyboard.press("p")
        opened.value.locator("body[data-drawn]").wait_for()
        return opened.value

    def press(self, *keys):
        """Press keys in the deck."""
        for key in keys:
            self.page.keyboard.press(key)

    @property
    def number(self):
        """str, the number of the slide as the deck gives it."""
        return self.page.locator(".slamlab-number").text_content()


def draw(page, *points):
    """Draw through points of the page with the mouse."""
    page.mouse.move(*points[0])
    page.mouse.down()
    for point in points[1:]:
        page.mouse.move(*point, steps=5)
    page.mouse.up()
