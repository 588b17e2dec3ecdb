"""A JupyterLab with a home of its own, and a browser that reaches nothing else."""

import json
import os
import shutil
import subprocess
import sys
import time
from contextlib import contextmanager

from axe_playwright_python.sync_playwright import Axe

from course.source import ROOT
from tests.patience import PATIENCE

CHROMIUMS = ("chromium", "chromium-browser", "google-chrome", "chrome")
EXTENSION = ROOT / "labextension" / "share" / "jupyter"
IDLE = ".jp-Notebook-ExecutionIndicator[data-status=idle]"  # out of sight on a narrow page
NEWS = "@jupyterlab/apputils-extension:announcements"


# what was never in sight is not laid out
LOOK_THROUGH = """async () => {
    for (const cell of document.querySelectorAll(".jp-Cell")) {
        cell.scrollIntoView();
        for (let frame = 0; frame < 2; frame++) await new Promise(requestAnimationFrame);
    }
}"""

# how many cells still wait or run, once that is another number than before
CELLS_LEFT = """(before) => {
    const prompts = [...document.querySelectorAll(".jp-InputPrompt")];
    const left = prompts.filter((prompt) => prompt.textContent == "[*]:").length;
    return left != before && [left];
}"""


class Unavailable(Exception):
    """There is no browser, or JupyterLab does not start; the text says which."""


@contextmanager
def chromium():
    """Chromium, without a window.

    Yields
    ------
    Browser of Playwright

    Raises
    ------
    Unavailable : no Playwright or no Chromium
    """
    try:
        from playwright.sync_api import sync_playwright
    except ImportError:
        raise Unavailable("Playwright is not installed") from None
    path = next(filter(None, map(shutil.which, CHROMIUMS)), None)
    if not path:
        raise Unavailable("no Chromium here: what is shown in a browser stays untested")
    quiet = ["--disable-gpu", "--disable-background-networking", "--disable-component-update"]
    with sync_playwright() as running:
        opened = running.chromium.launch(executable_path=path, args=["--no-sandbox", *quiet])
        yield opened
        opened.close()


@contextmanager
def jupyterlab(home):
    """A JupyterLab as ``lab.py`` sets it up.

    Parameters
    ----------
    home : Path, a folder with ``course/notebooks/``; all it writes goes there

    Yields
    ------
    str, the address of a notebook, with ``{}`` for its name, or its path from the course's folder

    Raises
    ------
    Unavailable : it does not start
    """
    settings = home / "config" / "labconfig" / "page_config.json"
    settings.parent.mkdir(parents=True, exist_ok=True)
    settings.write_text(json.dumps({"disabledExtensions": {NEWS: True}}))
    places = {"HOME": home, "JUPYTER_CONFIG_DIR": home / "config", "IPYTHONDIR": home / "ipython"}
    places |= {"JUPYTER_RUNTIME_DIR": home / "runtime", "JUPYTER_DATA_DIR": home / "data"}
    places["JUPYTER_PATH"] = EXTENSION  # as it stands here, not as it was installed
    options = ["--no-browser", "--allow-root", "--ip=127.0.0.1", "--port=0"]
    # a test is no student, but these play one: their progress is kept
    student = {name: value for name, value in os.environ.items() if name != "PYTEST_VERSION"}
    shutil.rmtree(home / "runtime", ignore_errors=True)  # of a server before
    with open(home / "said.txt", "w") as said:
        server = subprocess.Popen(
            [sys.executable, "-m", "jupyterlab", *options],
            cwd=home / "course",
            env=student | {name: str(place) for name, place in places.items()},
            stdin=subprocess.DEVNULL,
            stdout=said,
            stderr=subprocess.STDOUT,
        )
    try:
        yield _address(server, home)
    finally:
        server.terminate()
        server.wait(PATIENCE)


def _address(server, home):
    """The address with the token, once the server has written it down."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end and server.poll() is None:
        for file in (home / "runtime").glob("jpserver-*.json"):
            try:
                told = json.loads(file.read_text())
            except json.JSONDecodeError:
                continue  # half written
            return f"{told['url']}lab/tree/{{}}?reset&token={told['token']}"
        time.sleep(0.1)
    raise Unavailable("JupyterLab did not start:\n" + (home / "said.txt").read_text()[-2000:])


class Visit:
    """A page of JupyterLab, with what went wrong on it and what it asked of other machines."""

    def __init__(self, page, address):
        self.page, self.address = page, address
        self.errors, self.abroad = [], []
        page.set_default_timeout(1000 * PATIENCE)
        page.on("console", self._heard)
        page.on("pageerror", lambda error: self.errors.append(str(error)))
        page.on("request", self._asked)

    def open(self, notebook):
        """Open a notebook and wait until its kernel is ready."""
        path = notebook if "/" in notebook else f"notebooks/{notebook}"
        self.page.goto(self.address.format(path))
        self.page.wait_for_selector(".jp-NotebookPanel .jp-Cell")
        self.page.wait_for_selector(IDLE, state="attached")
        # the indicator is idle before there is a kernel, too
        self.page.get_by_text("| Idle").wait_for(state="attached")

    def run_all(self):
        """Run all cells of the notebook that is open, by the menu."""
        self.page.get_by_role("menuitem", name="Run", exact=True).click()
        self.page.locator(".lm-Menu-item").get_by_text("Run All Cells", exact=True).click()

    def run_all_and_wait(self):
        """Run all cells and wait until the last one is done: as long as one after another ends."""
        self.run_all()
        left = 0
        while (left := self.page.wait_for_function(CELLS_LEFT, arg=left).json_value()[0]) > 0:
            pass
        self.page.wait_for_selector(IDLE, state="attached")

    def save(self):
        """Save the notebook and wait until it is."""
        self.page.keyboard.press("Control+s")
        self.page.wait_for_selector(".jp-mod-current.jp-mod-dirty", state="detached")

    @property
    def is_dirty(self):
        """bool, whether the tab says that something is unsaved."""
        return self.page.locator(".lm-TabBar-tab.jp-mod-dirty").count() > 0

    def serious_faults(self):
        """Faults of accessibility in the notebook's own area, serious or critical, by axe-core.

        Returns
        -------
        list of str, the rule and where it is broken
        """
        self.page.evaluate(LOOK_THROUGH)
        found = Axe().run(
            self.page,
            context=".jp-NotebookPanel .jp-WindowedPanel-viewport",
            options={"resultTypes": ["violations"]},
        )
        return [
            f"{broken['id']}: {node['html'][:200]}"
            for broken in found.response["violations"]
            if broken["impact"] in ("serious", "critical")
            for node in broken["nodes"]
            # a long line of code scrolls with the cursor, once Enter has led into the editor
            if "cm-scroller" not in node["html"]
        ]

    def run(self, cell):
        """Run a cell, given by its position, and wait until it is done.

        Returns
        -------
        Locator of the cell
        """
        place = self.page.locator(".jp-Cell").nth(cell)
        prompt = place.locator(".jp-InputPrompt")
        before = prompt.text_content()
        place.locator(".cm-content").click()
        self.page.keyboard.press("Control+Enter")
        self.page.wait_for_function(
            "([prompt, before]) => ![before, '[*]:'].includes(prompt.textContent)",
            arg=[prompt.element_handle(), before],
        )
        return place

    def _heard(self, message):
        if message.type == "error":
            self.errors.append(message.text)

    def _asked(self, request):
        local = ("http://127.0.0.1:", "http://localhost:", "data:", "blob:")
        if not request.url.startswith(local):
            self.abroad.append(request.url)
