"""A live run in a page of a real browser, as ``slamlab live`` opens it, with typed commands."""

import re

import numpy as np

from tests.course.browser.watching import watch
from tests.slamlab.devices.test_emulator_ports import command
from tests.timeouts import PATIENCE, until


def started(*words):
    """Start ``slamlab live``.

    Returns
    -------
    (Popen, str), the process and the address that it prints
    """
    process = command("live", *words, "--no-open")
    first = process.stdout.readline()
    assert first.startswith("open "), first + process.communicate(timeout=PATIENCE)[0]
    return process, first.split()[1]


class LivePage:
    """A page of a live run.

    Parameters
    ----------
    browser : Browser of Playwright
    address : str, with the token
    """

    def __init__(self, browser, address):
        self.browser, self.address, self.moves, self.pages = browser, address, 0, []
        self.errors, self.foreign_requests = [], []
        self.page = self.look()
        self.status = self.page.locator(".slamlab-status")

    def look(self, address=None):
        """Another page that looks."""
        context = self.browser.new_context(viewport={"width": 1000, "height": 900})
        page = context.new_page()
        watch(page, (self.address.split("#")[0],), self.errors, self.foreign_requests)
        page.goto(address or self.address)
        self.pages.append(context)
        if address is None:
            # the picture is painted once before its first frame is there
            page.locator(".slamlab-status", has_text="pose").wait_for()
        return page

    def type(self, text):
        """Type a line."""
        self.page.get_by_label("distance, angle").fill(text)
        self.page.get_by_label("distance, angle").press("Enter")

    def move(self, text):
        """Type a move and wait until it is made."""
        self.type(text)
        self.moves += 1
        self.page.wait_for_function(
            "(moves) => Number(document.getElementById('driver').dataset.ended ?? 0) >= moves",
            arg=self.moves,
        )

    def pose(self):
        """The pose that the page shows, (3,) [m, m, rad]."""
        reported = re.search(r"pose (\S+) m, (\S+) m, (\S+)°", self.status.text_content())
        x, y, degrees = map(float, reported.groups())
        return np.array([x, y, np.radians(degrees)])

    def steps(self):
        """Number of readings that the page shows."""
        return int(re.search(r"step (\d+)", self.status.text_content())[1])

    def go_to(self, x, y):
        """Turn to a position and drive there, by the pose that the page shows.

        On a busy machine the drive lock may expire and the robot stop on the path: then repeat.
        """

        def is_there():
            return np.hypot(*self.pose()[:2] - (x, y)) <= 0.05

        def go():
            from_x, from_y, heading = self.pose()
            turn = np.angle(np.exp(1j * (np.arctan2(y - from_y, x - from_x) - heading)))
            self.move(f"{np.hypot(x - from_x, y - from_y):.3f}, {np.degrees(turn):.2f}")

        until(lambda: is_there() or go())

    def exit(self):
        """Type exit and wait for the program's end."""
        self.type("exit")
        self.page.get_by_text("The program has ended.").wait_for()

    def close(self):
        """Close the pages."""
        for context in self.pages:
            context.close()
