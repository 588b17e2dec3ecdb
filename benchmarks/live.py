"""Live views in a real browser, in a notebook and by ``slamlab live``: latency and frame rate.

The peer is an ipywidgets.Image with a full redraw by matplotlib, in the same notebook and run.
Another row gives the time from a click to the response while a source blocks for a second. Goals on
an idle machine: 100 ms, 10 frames/s, and at most one frame in transit.
"""

import sys
import tempfile
from pathlib import Path

import nbformat

from benchmarks import live_page
from benchmarks.common import Missing, main, row
from benchmarks.live_measures import measured, pressed
from tests.course.browser.jupyter import Unavailable, Visit, chromium, jupyterlab
from tests.course.browser.live import View
from tests.course.browser.measuring import NAME, notebook

TITLE = "Live view in JupyterLab and headless Chromium, 20 000 points (wall time)"
AGG = "Image, full Agg redraw"
GOAL_MS, GOAL_FPS = 100, 10


def run(quick):
    """Make rows for both maps, live and redrawn."""
    with tempfile.TemporaryDirectory() as folder:
        notebooks = Path(folder, "course", "notebooks")
        notebooks.mkdir(parents=True)
        nbformat.write(notebook(), notebooks / NAME)
        try:
            with chromium() as browser, jupyterlab(Path(folder)) as address:
                page = browser.new_page(viewport={"width": 1280, "height": 800})
                return rows(Visit(page, address), quick)
        except Unavailable as reason:
            raise Missing(str(reason)) from None


def rows(visit, quick):
    """Run the notebook's cells, measure the latency and frame rate of each picture, and make
    rows."""
    visit.open(NAME)
    visit.run_all()
    late, cell = (visit.page.locator(".jp-Cell").nth(position) for position in (3, 4))
    image = cell.locator("img.widget-image")
    image.wait_for()
    visit.page.wait_for_timeout(1000)
    # the image last: it does not acknowledge frames, so those in transit would disturb the others
    views = {"live, map grows": View(visit.page, 1), "live, all points new": View(visit.page, 2)}
    lives = {
        name: (view, *measured(view.cell, view.root, "▶ run", "❚❚ pause", quick))
        for name, view in views.items()
    }
    toggle = late.get_by_role("button", name="▶ run").element_handle()
    answer = pressed(visit.page, toggle, toggle, quick)
    redrawn = measured(cell, image, "run", "run", quick)
    found = [
        row(f"click → picture: {AGG}", redrawn[0], "ms", AGG, 1),
        row(f"pictures a second: {AGG}", redrawn[1], "1/s", AGG, 1),
        row(
            "click → run or pause: source blocks",
            answer,
            "ms",
            f"goal {GOAL_MS} ms",
            GOAL_MS / answer,
        ),
    ]
    for name, (view, wait, rate) in lives.items():
        behind = view.behind()
        found += [
            row(f"click → picture: {name}", wait, "ms", AGG, redrawn[0] / wait),
            row(f"click → picture: {name}", wait, "ms", f"goal {GOAL_MS} ms", GOAL_MS / wait),
            row(f"pictures a second: {name}", rate, "1/s", AGG, rate / redrawn[1]),
            row(f"pictures a second: {name}", rate, "1/s", f"goal {GOAL_FPS}/s", rate / GOAL_FPS),
            row(f"frames in transit, at most: {name}", behind, "1", "goal 1", 1 / behind),
        ]
    return found


if __name__ == "__main__":
    sys.exit(main({TITLE: run, live_page.TITLE: live_page.run}, "python -m benchmarks.live"))
