"""Start the class's process, or find the one that runs."""

import json
import os
import re
import subprocess
import sys
import urllib.error
import urllib.request
from pathlib import Path

from filelock import FileLock
from jupyter_core.paths import jupyter_runtime_dir

PORT = 8765
ORIGIN = re.compile(r"https?://([A-Za-z0-9.-]+|\[[0-9a-f:]+\])(:[0-9]{1,5})?")
# What Python needs to find its libraries and a folder for temporary files; no token, no name of
# a server, and no proxy.
KEPT = ("PATH", "PYTHONPATH", "PYTHONHOME", "LD_LIBRARY_PATH", "SYSTEMROOT", "HOME", "USERPROFILE",
        "APPDATA", "TMPDIR", "TEMP", "TMP", "LANG", "LC_ALL")  # fmt: skip


def origin(text):
    """An origin as browsers name it.

    Parameters
    ----------
    text : str

    Returns
    -------
    str

    Raises
    ------
    ValueError : it is none
    """
    if not ORIGIN.fullmatch(text):
        raise ValueError(f"{text!r} is no origin such as http://localhost:8888")
    return text


def start(page, host="127.0.0.1", port=PORT):
    """Start the process that listens for phones; if it runs already, say where.

    Parameters
    ----------
    page : str, the origin of the lecturer's page, such as "http://localhost:8888"
    host : str, on which phones are listened for: "127.0.0.1", this machine alone; "0.0.0.0", all
    port : int, for phones; any other one if it is taken

    Returns
    -------
    dict : ``addresses``, each with its QR code, and ``code`` for phones; for the page ``control``,
        an address, and ``key``

    Raises
    ------
    ValueError : no origin
    RuntimeError : it cannot listen there
    """
    wanted = {"origin": origin(page), "host": host}
    folder = Path(jupyter_runtime_dir())
    folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    state = folder / "slamlab-audience.json"
    with FileLock(state.with_suffix(".lock"), timeout=60):
        running = _running(state)
        if running is not None:
            if wanted.items() <= running.items():
                return running
            _ask(running, "POST", "/end")
        return _started(wanted, port, state)


def _started(wanted, port, state):
    words = [wanted["origin"], "--host", wanted["host"], "--port", str(port), "--state", str(state)]
    child = subprocess.Popen(
        # -P: a module in the folder of the notebook is no module of this process
        [sys.executable, "-P", "-m", "slamlab.audience", *words],
        env={name: os.environ[name] for name in KEPT if name in os.environ},
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,  # an interrupted kernel does not end the poll
    )
    with child.stdout, child.stderr:
        line = child.stdout.readline()
        if line:
            return json.loads(line)
        raise RuntimeError(child.stderr.read().strip() or "the class's process ended at once")


def _running(state):
    """What the process told that runs, None where there is none."""
    try:
        told = json.loads(state.read_text())
        _ask(told, "GET", "/alive")
    except (OSError, ValueError, KeyError):  # no file, an old one, nobody there
        return None
    return told


def _ask(told, method, path):
    request = urllib.request.Request(told["control"] + path, method=method)
    request.add_header("Origin", told["origin"])
    request.add_header("Authorization", f"Bearer {told['key']}")
    direct = urllib.request.build_opener(urllib.request.ProxyHandler({}))
    with direct.open(request, timeout=10) as answer:
        return answer.read()
