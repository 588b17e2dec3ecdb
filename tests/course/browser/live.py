"""A notebook with live views, and what a test can see of them in the browser."""

import time

import nbformat

from tests.timeouts import PATIENCE

NAME = "live_views.ipynb"

SETUP = """\
from functools import partial
import numpy as np
from slamlab import estimators, live, sources
from slamlab.layers import Segments"""

DRIVEN = """\
loop = live.watch(
    {
        f"Simulation {n}": partial(sources.simulation, f"situation-{n}", tour=False)
        for n in (1, 2)
    },
    partial(estimators.make, "walls"),
    "A robot and the points it has seen.",
    steps=1,
    speed=20,
    extra=lambda pair: [Segments("walls", pair.source.world.outline())],
)"""

PLAYED = """\
def off(pair, estimator):
    return np.hypot(*(estimator.pose - pair.source.truth.poses[pair.count - 1])[:2])

loop = live.watch(
    partial(sources.simulation, "landmarks"),
    partial(estimators.make, "mak"),
    "A robot on a loop among landmarks.",
    beside={"naive": lambda source: estimators.DeadReckoning()},
    curves={
        "error [m]": {
            "naive": lambda pair: off(pair, pair.others["naive"]),
            "corrected": lambda pair: off(pair, pair.estimator),
        }
    },
    speed=20,
)"""

RASTERED = """\
_ = live.watch(
    partial(sources.simulation, "room"), partial(estimators.make, "icp"), "A room.", raster=True
)"""


def notebook():
    """A notebook never run: imports, a robot to drive, a recording to play, one without JavaScript.

    Returns
    -------
    NotebookNode
    """
    return fresh(SETUP, DRIVEN, PLAYED, RASTERED)


def fresh(*cells):
    """A notebook of such cells; of those given as text, never run."""
    made = nbformat.v4.new_notebook()
    made.cells = [nbformat.v4.new_code_cell(c) if isinstance(c, str) else c for c in cells]
    made.metadata["kernelspec"] = {"name": "python3", "display_name": "Python 3 (ipykernel)"}
    return made


class View:
    """The live view of one cell.

    Parameters
    ----------
    page : Page of Playwright
    cell : int, position in the notebook
    """

    def __init__(self, page, cell):
        self.page, self.cell = page, page.locator(".jp-Cell").nth(cell)
        self.root = self.cell.locator(".slamlab-live")
        self.canvas = self.root.locator("canvas")

    def press(self, text):
        """Press a button by its text."""
        self.cell.get_by_role("button", name=text, exact=True).click()

    def frame(self):
        """Number of the frame that is drawn."""
        return int(self.root.get_attribute("data-frame"))

    def behind(self):
        """How many frames were on their way at most."""
        return int(self.root.get_attribute("data-behind"))

    def status(self):
        """The line below the picture."""
        return self.root.locator(".slamlab-status").text_content()

    def picture(self):
        """The picture, as text."""
        return self.canvas.evaluate("canvas => canvas.toDataURL()")

    def until(self, message):
        """Wait until something about the picture is true, given as a function of its text."""
        end = time.monotonic() + PATIENCE
        while not message(self.picture()):
            assert time.monotonic() < end, "the picture stays as it is"
            self.page.wait_for_timeout(20)

    def rest(self):
        """Wait until no more frames come."""
        frame, end = None, time.monotonic() + PATIENCE
        while frame != (frame := self.frame()):
            assert time.monotonic() < end, "frames still come"
            self.page.wait_for_timeout(300)

    def wait(self, frame):
        """Wait until a frame or a later one is drawn."""
        self.page.wait_for_function(
            "([root, frame]) => Number(root.dataset.frame) >= frame",
            arg=[self.root.element_handle(), frame],
        )
