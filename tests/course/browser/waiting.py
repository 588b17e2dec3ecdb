"""A notebook with a busy kernel, and with a robot that delays the view."""

from tests.course.browser.live import PLAYED, SETUP, View, fresh

NAME = "waiting.ipynb"
GO = "go.txt"  # what the last cell waits for

SILENT = """\
import threading
from slamlab.sources.base import Source

class Silent(Source):
    def __init__(self, rng):
        super().__init__()
        self.closed = threading.Event()

    def __iter__(self):
        self.closed.wait()  # as for a reading of a robot that is off
        return
        yield

    def close(self):
        self.closed.set()

_ = live.watch(Silent, lambda source: estimators.DeadReckoning(), "A robot that is off.")"""

THREADS = "sum('reading' in thread.name for thread in threading.enumerate())"

BUSY = f"""\
import time
from pathlib import Path
while not Path("{GO}").exists():
    time.sleep(0.1)"""


def notebook():
    """A notebook never run: a recording, a robot that is off, its threads, a cell that lasts.

    Returns
    -------
    NotebookNode
    """
    return fresh(SETUP, PLAYED, SILENT, THREADS, BUSY)


class Waiting:
    """The notebook in the browser.

    Parameters
    ----------
    visit : Visit
    """

    def __init__(self, visit):
        self.visit = visit
        self.played, self.silent = (View(visit.page, cell) for cell in (1, 2))

    @property
    def busy(self):
        """bool, whether the kernel runs a cell."""
        return self.visit.page.get_by_text("| Busy").is_visible()

    def clear(self, cell):
        """Clear what stands below a cell."""
        self.visit.page.locator(".jp-Cell").nth(cell).locator(".cm-content").click()
        self.visit.page.get_by_role("menuitem", name="Edit", exact=True).click()
        self.visit.page.get_by_text("Clear Cell Output", exact=True).click()

    def until_threads(self, count):
        """Wait until so many threads of the kernel wait for a reading."""
        for _ in range(30):
            output = self.visit.run(3).locator(".jp-OutputArea-output").text_content()
            if output.strip() == str(count):
                return
            self.visit.page.wait_for_timeout(500)
        raise AssertionError(f"{output} threads wait, not {count}")
