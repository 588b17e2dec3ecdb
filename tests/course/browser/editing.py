"""A notebook with a world editor, and what a test can do there."""

import json

from tests.course.browser.live import fresh

NAME = "editing.ipynb"

SHOWN = """\
import json
import numpy as np
from slamlab.simulation.range_scanners import RPLIDAR_A2
from slamlab.live.editor import edit_world
from slamlab.simulation.worlds.world_files import parse

def scan(world):
    return RPLIDAR_A2.scan(world, np.zeros(3), np.random.default_rng(2)).points()

ROWS = '''\\
-2 -1 2 -1
2 -1 2 1
2 1 -2 1
-2 1 -2 -1
1 0.5 0.2
'''
editor = edit_world(parse(ROWS), "A room with a pillar.", scan)"""

PRINT_WORLD = "print(json.dumps([editor.world.walls.tolist(), editor.world.circles.tolist()]))"


def notebook():
    """A notebook never run: an editor, and a cell that shows the kernel's state.

    Returns
    -------
    NotebookNode
    """
    return fresh(SHOWN, PRINT_WORLD)


class Editor:
    """The editor of a notebook's first cell; its second one shows the kernel's state.

    Parameters
    ----------
    visit : Visit
    """

    def __init__(self, visit):
        self._visit, self.page = visit, visit.page
        self.cell = self.page.locator(".jp-Cell").nth(0)
        self.canvas = self.cell.locator(".slamlab-world-canvas canvas")
        self.rows = self.cell.locator("textarea")

    def handle(self, name):
        """The handle of a point, by the beginning of what it is called."""
        return self.cell.locator(f".slamlab-handle[aria-label^='{name}']")

    def at(self, name):
        """Where a handle stands on the page [px]."""
        self.handle(name).scroll_into_view_if_needed()
        box = self.handle(name).bounding_box()
        return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    def press(self, text):
        """Press a button by its text."""
        self.cell.get_by_role("button", name=text, exact=True).click()

    def picture(self):
        """The picture, as text."""
        return self.canvas.evaluate("canvas => canvas.toDataURL()")

    def until(self, rows, there=True):
        """Wait until the rows hold a text, or no longer do."""
        self.page.wait_for_function(
            "([area, text, there]) => area.value.includes(text) == there",
            arg=[self.rows.element_handle(), rows, there],
        )

    def until_drawn(self, picture):
        """Wait until a picture is seen."""
        self.page.wait_for_function(
            "([canvas, picture]) => canvas.toDataURL() == picture",
            arg=[self.canvas.element_handle(), picture],
        )

    def kernel(self):
        """Walls and circles that the kernel has."""
        reported = self._visit.run(1).locator(".jp-OutputArea-output")
        return json.loads(reported.text_content())
