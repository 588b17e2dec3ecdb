"""Live views in a real browser, in a notebook and by ``slamlab live``: latency, frame rate.

Against an ipywidgets.Image that gets a full redraw by matplotlib, in the same notebook and run;
and from a click to the answer while a source keeps one waiting for a second.
Goals on an idle machine: 100 ms, 10 frames/s; never more than one frame on its way.
"""

import statistics
import sys
import tempfile
from pathlib import Path

import nbformat

from benchmarks import live_page
from benchmarks.common import Missing, main, row
from tests.browser.jupyter import Unavailable, Visit, chromium, jupyterlab
from tests.browser.live import View
from tests.browser.measuring import NAME, notebook

TITLE = "Live view in JupyterLab and headless Chromium, 20 000 points (wall time)"
AGG = "Image, full Agg redraw"
GOAL_MS, GOAL_FPS = 100, 10

# calls back after each picture of a live view or an image, or each new text of a button
WATCH = """
([root, back]) => {
  if (root.tagName != "IMG") {
    const watcher = new MutationObserver(back);
    watcher.observe(root, { attributeFilter: ["data-frame"], childList: true });
    return () => watcher.disconnect();
  }
  root.addEventListener("load", back);
  return () => root.removeEventListener("load", back);
}
"""
CLICK = f"""
([root, button]) => new Promise((done) => {{
  const begin = performance.now();
  const end = ({WATCH})([root, () => {{ end(); done(performance.now() - begin); }}]);
  button.click();
}})
"""
COUNT = f"""
([root, seconds]) => new Promise((done) => {{
  const begin = performance.now();
  let pictures = 0;
  const end = ({WATCH})([root, () => {{ pictures += 1; }}]);
  setTimeout(() => {{
    end();
    done(1000 * pictures / (performance.now() - begin));
  }}, 1000 * seconds);
}})
"""


def measured(cell, root, run, pause, quick):
    """Latency: median time from a click to the picture [ms]; frame rate, pictures a second.

    Parameters
    ----------
    cell, root : Locator of the cell and of what is drawn in it
    run, pause : str, the text of the buttons
    quick : bool, fewer presses and less time
    """
    page, shown = cell.page, root.element_handle()

    def button(text):
        return cell.get_by_role("button", name=text, exact=True)

    wait = pressed(page, shown, button("step").element_handle(), quick)
    button(run).click()
    page.wait_for_timeout(500)
    rate = page.evaluate(COUNT, [shown, 2 if quick else 6])
    button(pause).click()
    page.wait_for_timeout(1500)  # what is on its way arrives
    return wait, rate


def pressed(page, shown, button, quick):
    """Median time from a click on a button to a change of what is shown [ms]."""
    presses = 5 if quick else 30
    waits = [page.evaluate(CLICK, [shown, button]) for _ in range(3 + presses)][3:]
    return statistics.median(waits)


def run(quick):
    """Rows for both maps, live and redrawn."""
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
    """Rows: run the notebook's cells and measure latency and frame rate of each picture."""
    visit.open(NAME)
    visit.run_all()
    late, cell = (visit.page.locator(".jp-Cell").nth(position) for position in (3, 4))
    image = cell.locator("img.widget-image")
    image.wait_for()
    visit.page.wait_for_timeout(1000)
    # the image last: it acknowledges nothing, so what is on its way would disturb the others
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
            "click → run or pause: source waits",
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
            row(f"frames on their way, at most: {name}", behind, "1", "goal 1", 1 / behind),
        ]
    return found


if __name__ == "__main__":
    sys.exit(main({TITLE: run, live_page.TITLE: live_page.run}, "python -m benchmarks.live"))
