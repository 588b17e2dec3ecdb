"""Headless browser and a separate JupyterLab, for rehearsals, handouts and tests."""

import json
import os
import shutil
import subprocess
import sys
import time
from contextlib import contextmanager, suppress

PROGRAMS = ("chromium", "chromium-browser", "google-chrome", "chrome", "microsoft-edge", "msedge")
CHANNELS = ("chrome", "msedge", None)  # Playwright's own search; None: its own Chromium
NEWS = "@jupyterlab/apputils-extension:announcements"
PATIENCE = 300  # timeout for the start of JupyterLab [s]
STOP_TIMEOUT = 20  # for its kernels to end; then it is killed [s]
NO_PLAYWRIGHT = (
    "Playwright is missing. Set up the course with `python lab.py --lecture`, in the whole project "
    "or the lecturers' pack"
)
NO_BROWSER = (
    "no Chromium, Chrome or Edge was found. Install one of them, or let Playwright install a "
    "Chromium with `python -m playwright install chromium`"
)
QUIET = ("--disable-gpu", "--disable-background-networking", "--disable-component-update")


class Unavailable(Exception):
    """No browser was found, or JupyterLab does not start; the message explains what to do."""


@contextmanager
def chromium():
    """Open a headless Chromium, Chrome or Edge with Playwright; raise Unavailable if none is
    found."""
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
def jupyterlab(root, environment=(), patience=PATIENCE, port=0):
    """Run a JupyterLab in ``root``/course that writes only to ``root``; raise Unavailable if it
    fails.

    Yields the address of notebooks, in which ``{}`` stands for a path. patience : timeout [s].
    port : 0 for any."""
    settings = root / "config" / "labconfig" / "page_config.json"
    settings.parent.mkdir(parents=True, exist_ok=True)
    # expose the application to scripts of the page
    settings.write_text(
        json.dumps({"disabledExtensions": {NEWS: True}, "exposeAppInBrowser": True})
    )
    places = {"HOME": root, "JUPYTER_CONFIG_DIR": root / "config", "IPYTHONDIR": root / "ipython"}
    places |= {"JUPYTER_RUNTIME_DIR": root / "runtime", "JUPYTER_DATA_DIR": root / "data"}
    options = ["--no-browser", "--allow-root", "--ip=127.0.0.1", f"--port={port}"]
    known = os.environ | {name: str(value) for name, value in (places | dict(environment)).items()}
    shutil.rmtree(root / "runtime", ignore_errors=True)  # of an earlier server
    with open(root / "output.txt", "w") as output:
        server = subprocess.Popen(
            [sys.executable, "-m", "jupyterlab", *options],
            cwd=root / "course",
            env=known,
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=subprocess.STDOUT,
        )
    try:
        yield _address(server, root, patience)
    finally:
        server.terminate()
        try:
            server.wait(STOP_TIMEOUT)
        except subprocess.TimeoutExpired:
            server.kill()
            server.wait()


def _address(server, root, patience):
    end = time.monotonic() + patience
    while time.monotonic() < end and server.poll() is None:
        for file in (root / "runtime").glob("jpserver-*.json"):
            try:
                state = json.loads(file.read_text())
            except json.JSONDecodeError:
                continue  # still being written
            return f"{state['url']}lab/tree/{{}}?reset&token={state['token']}"
        time.sleep(0.1)
    raise Unavailable("JupyterLab did not start:\n" + (root / "output.txt").read_text()[-2000:])


if __name__ == "__main__":
    try:
        with chromium() as browser:
            print(f"found Chromium, version {browser.version}")
    except Unavailable as reason:
        sys.exit(str(reason))
