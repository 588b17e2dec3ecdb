"""Page of a live run (``slamlab live``) in a real browser; a part of ``benchmarks.live``.

Goals on an idle machine: 30 pictures per second with 20 000 points, 50 ms from a click to the
picture, and at most one frame in transit.
"""

import asyncio
from concurrent.futures import Future, ThreadPoolExecutor

import numpy as np

from benchmarks.common import Missing, row
from benchmarks.live_measures import measured
from classroom.lecturing.headless import Unavailable, chromium
from slamlab.estimators.base import Estimator
from slamlab.layers import Points, Poses
from slamlab.live.console.console_server import serve
from slamlab.live.console.control_panel import ControlPanel
from slamlab.live.console.recorded_run import RecordedRun
from slamlab.readings import Reading
from slamlab.sources.base import Source

TITLE = "slamlab live in headless Chromium, 20 000 points (wall time)"
GOAL_MS, GOAL_RATE = 50, 30
POINTS = 20_000


class Clock(Source):
    """A source that yields only times."""

    def __iter__(self):
        step = 0
        while True:
            yield Reading(time=float(step))
            step += 1


class Cloud(Estimator):
    """A map of many points, which grows or changes at each step."""

    def __init__(self, grows):
        super().__init__()
        self._grows, self._rng, self._count = grows, np.random.default_rng(0), 0
        self._points = self._rng.uniform(-5, 5, (POINTS, 2))

    def step(self, reading):
        """Add or replace points for one more reading."""
        self._count += 1
        few = self._rng.uniform(-5, 5, (20 if self._grows else POINTS, 2))
        self._points = np.vstack([self._points, few]) if self._grows else few

    def layers(self):
        """Return the points, and a robot that moves in a circle."""
        angle = self._count / 20
        here = [[np.cos(angle), np.sin(angle), angle]]
        return [Points("map", self._points), Poses("corrected", here)]


def run(quick):
    """Make rows for both maps."""
    try:
        with chromium() as browser:
            page = browser.new_page(viewport={"width": 1280, "height": 800})
            found = []
            for name, grows in (("map grows", True), ("all points new", False)):
                found += _rows(page, name, grows, quick)
            return found
    except Unavailable as reason:
        raise Missing(str(reason)) from None


def _rows(page, name, grows, quick):
    live_run = RecordedRun(lambda rng: Clock(), lambda source: Cloud(grows))
    address = Future()

    async def served():
        live_run.reset(0)
        await serve(ControlPanel(live_run, name, speed=100), started=address.set_result)

    with ThreadPoolExecutor(1) as thread:
        done = thread.submit(asyncio.run, served())
        try:
            page.goto(address.result(60))
            root, panel = page.locator(".slamlab-live[data-frame]"), page.locator("#panel")
            root.wait_for()
            panel.get_by_role("button", name="❚❚ pause").click()
            wait, rate = measured(panel, root, "▶ run", "❚❚ pause", quick)
            behind = int(root.get_attribute("data-behind"))
        finally:
            page.locator("#line").fill("exit")
            page.locator("#line").press("Enter")
            done.result(60)
    return [
        row(f"click → picture: {name}", wait, "ms", f"goal {GOAL_MS} ms", GOAL_MS / wait),
        row(f"pictures a second: {name}", rate, "1/s", f"goal {GOAL_RATE}/s", rate / GOAL_RATE),
        row(f"frames in transit, at most: {name}", behind, "1", "goal 1", 1 / max(behind, 1)),
    ]
