"""A JupyterLab on a copy of the lessons, and a browser that reaches nothing else."""

import json
import os
import shutil
import subprocess
import sys
import time

import nbformat
import pytest

from course.source import ROOT
from tests.browser import live

CHROMIUMS = ("chromium", "chromium-browser", "google-chrome", "chrome")
NEWS = "@jupyterlab/apputils-extension:announcements"
PATIENCE = 60  # [s] for anything that is being waited for; what is there is not waited for


@pytest.fixture(scope="session")
def browser():
    """Chromium, without a window."""
    playwright = pytest.importorskip("playwright.sync_api", reason="Playwright is not installed")
    path = next(filter(None, map(shutil.which, CHROMIUMS)), None)
    if not path:
        pytest.skip("no Chromium here: what is shown in a browser stays untested")
    quiet = ["--disable-gpu", "--disable-background-networking", "--disable-component-update"]
    with playwright.sync_playwright() as running:
        opened = running.chromium.launch(executable_path=path, args=["--no-sandbox", *quiet])
        yield opened
        opened.close()


@pytest.fixture(scope="session")
def lab(tmp_path_factory):
    """The address of a JupyterLab as ``lab.py`` sets it up, with a home of its own."""
    home = tmp_path_factory.mktemp("lab")
    shutil.copytree(ROOT / "notebooks", home / "course" / "notebooks")
    nbformat.write(live.notebook(), home / "course" / "notebooks" / live.NAME)
    settings = home / "config" / "labconfig" / "page_config.json"
    settings.parent.mkdir(parents=True)
    settings.write_text(json.dumps({"disabledExtensions": {NEWS: True}}))
    places = {"HOME": home, "JUPYTER_CONFIG_DIR": home / "config", "IPYTHONDIR": home / "ipython"}
    places |= {"JUPYTER_RUNTIME_DIR": home / "runtime", "JUPYTER_DATA_DIR": home / "data"}
    options = ["--no-browser", "--allow-root", "--ip=127.0.0.1", "--port=0"]
    with open(home / "said.txt", "w") as said:
        server = subprocess.Popen(
            [sys.executable, "-m", "jupyterlab", *options],
            cwd=home / "course",
            env=os.environ | {name: str(place) for name, place in places.items()},
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
            return f"{told['url']}lab/tree/notebooks/{{}}?reset&token={told['token']}"
        time.sleep(0.1)
    pytest.fail("JupyterLab did not start:\n" + (home / "said.txt").read_text()[-2000:])


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
        self.page.goto(self.address.format(notebook))
        self.page.wait_for_selector(".jp-NotebookPanel .jp-Cell")
        self.page.wait_for_selector(".jp-Notebook-ExecutionIndicator[data-status=idle]")

    def _heard(self, message):
        if message.type == "error":
            self.errors.append(message.text)

    def _asked(self, request):
        local = ("http://127.0.0.1:", "http://localhost:", "data:", "blob:")
        if not request.url.startswith(local):
            self.abroad.append(request.url)


@pytest.fixture
def visit(browser, lab):
    """A fresh page of JupyterLab."""
    context = browser.new_context(viewport={"width": 1280, "height": 800})
    yield Visit(context.new_page(), lab)
    context.close()
