"""Headless browser, and a JupyterLab with a home of its own: what rehearsal and tests run."""

import json
import os
import shutil
import subprocess
import sys
import time
from contextlib import contextmanager, suppress

PROGRAMS = ("chromium", "chromium-browser", "google-chrome", "chrome", "microsoft-edge", "msedge")
CHANNELS = ("chrome", "msedge", None)  # where Playwright looks by itself; None: its own Chromium
NEWS = "@jupyterlab/apputils-extension:announcements"
PATIENCE = 300  # [s] for JupyterLab to start: a guard against hanging
LEAVE = 20  # [s] for its kernels to end; it keeps nothing, so it is ended then
NO_PLAYWRIGHT = (
    "Playwright is missing: set up with `python lab.py --lecture`, in the whole project or the "
    "lecturers' pack"
)
NO_BROWSER = (
    "no Chromium, Chrome or Edge was found: install one of them, or let Playwright fetch a "
    "Chromium of its own with `python -m playwright install chromium`"
)
QUIET = ("--disable-gpu", "--disable-background-networking", "--disable-component-update")


class Unavailable(Exception):
    """There is no browser, or JupyterLab does not start; the text says which and what to do."""


@contextmanager
def chromium():
    """Open a browser of Chromium's family, without a window.

    Yields
    ------
    Browser of Playwright

    Raises
    ------
    Unavailable : no Playwright or no such browser
    """
    try:
        from playwright.sync_api import sync_playwright
    except ImportError:
        raise Unavailable(NO_PLAYWRIGHT) from None
    with sync_playwright() as running:
        opened = _launched(running.chromium)
        try:
            yield opened
        finally:
            opened.close()


def _launched(kind):
    from playwright.sync_api import Error

    found = [{"executable_path": path} for path in filter(None, map(shutil.which, PROGRAMS))]
    for where in [*found, *({"channel": name} for name in CHANNELS)]:
        with suppress(Error):
            return kind.launch(args=list(QUIET), **where)
    raise Unavailable(NO_BROWSER)


@contextmanager
def jupyterlab(home, environment=(), patience=PATIENCE):
    """Run a JupyterLab on the folder ``course`` of a home of its own, to which all it writes goes.

    Parameters
    ----------
    home : Path, a folder with ``course/``
    environment : dict of str or Path, variables besides those that are set here
    patience : float, for how long it may start [s]

    Yields
    ------
    str, the address of a notebook, with ``{}`` for its path from ``course/``

    Raises
    ------
    Unavailable : it does not start
    """
    settings = home / "config" / "labconfig" / "page_config.json"
    settings.parent.mkdir(parents=True, exist_ok=True)
    # the application is asked, not only looked at
    settings.write_text(
        json.dumps({"disabledExtensions": {NEWS: True}, "exposeAppInBrowser": True})
    )
    places = {"HOME": home, "JUPYTER_CONFIG_DIR": home / "config", "IPYTHONDIR": home / "ipython"}
    places |= {"JUPYTER_RUNTIME_DIR": home / "runtime", "JUPYTER_DATA_DIR": home / "data"}
    options = ["--no-browser", "--allow-root", "--ip=127.0.0.1", "--port=0"]
    known = os.environ | {name: str(value) for name, value in (places | dict(environment)).items()}
    shutil.rmtree(home / "runtime", ignore_errors=True)  # of a server before
    with open(home / "said.txt", "w") as said:
        server = subprocess.Popen(
            [sys.executable, "-m", "jupyterlab", *options],
            cwd=home / "course",
            env=known,
            stdin=subprocess.DEVNULL,
            stdout=said,
            stderr=subprocess.STDOUT,
        )
    try:
        yield _address(server, home, patience)
    finally:
        server.terminate()
        try:
            server.wait(LEAVE)
        except subprocess.TimeoutExpired:
            server.kill()
            server.wait()


def _address(server, home, patience):
    """The address with the token, once the server has written it down."""
    end = time.monotonic() + patience
    while time.monotonic() < end and server.poll() is None:
        for file in (home / "runtime").glob("jpserver-*.json"):
            try:
                told = json.loads(file.read_text())
            except json.JSONDecodeError:
                continue  # half written
            return f"{told['url']}lab/tree/{{}}?reset&token={told['token']}"
        time.sleep(0.1)
    raise Unavailable("JupyterLab did not start:\n" + (home / "said.txt").read_text()[-2000:])


if __name__ == "__main__":
    try:
        with chromium() as browser:
            print(f"found Chromium, version {browser.version}")
    except Unavailable as reason:
        sys.exit(str(reason))
