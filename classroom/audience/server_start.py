"""Starting the audience server, or finding a running one."""

import json
import os
import re
import subprocess
import sys
import urllib.parse
import urllib.request
from pathlib import Path

from filelock import FileLock
from jupyter_core.paths import jupyter_runtime_dir

from slamlab.live.web_server.http_server import HUB

PORT = 8765
ORIGIN = re.compile(r"https?://([A-Za-z0-9.-]+|\[[0-9a-f:]+\])(:[0-9]{1,5})?")
# Environment variables that Python needs to find its libraries and a folder for temporary files.
# Tokens, names of servers and proxies are left out.
KEPT = ("PATH", "PYTHONPATH", "PYTHONHOME", "LD_LIBRARY_PATH", "SYSTEMROOT", "HOME", "USERPROFILE",
        "APPDATA", "TMPDIR", "TEMP", "TMP", "LANG", "LC_ALL", HUB)  # fmt: skip


def origin(text):
    """Return the text if it is a web origin in the form that browsers use; otherwise raise
    ValueError."""
    if not ORIGIN.fullmatch(text):
        raise ValueError(f"{text!r} is not a web origin such as http://localhost:8888")
    return text


def start(page, host="127.0.0.1", port=PORT):
    """Start the audience server, or find the server that is already running.

    Parameters
    ----------
    page : str, the origin of the lecturer's page, such as "http://localhost:8888"
    host : str, the phones' address: "127.0.0.1" for this machine alone, "0.0.0.0" for all networks
    port : int, for phones; another one if it is taken

    Returns
    -------
    dict : ``addresses``, each with its QR code, and ``code`` for phones; ``control``, an address,
        and ``key``, a bearer token, for the lecturer's page

    Raises
    ------
    ValueError : not a web origin, or on a JupyterHub not its public one
    RuntimeError : the server does not start
    """
    wanted = {"origin": origin(page), "host": host}
    if not os.environ.get(HUB, page).startswith(page):
        raise ValueError(f"open this notebook at {os.environ[HUB]}, not at {page}")
    state = state_file()
    state.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
    with FileLock(state.with_suffix(".lock"), timeout=60):
        running = _running(state)
        if running is not None:
            if wanted.items() <= running.items():
                return running
            _request(running, "POST", "/end")
        return _started(wanted, port, state)


def state_file():
    """Return the path of the file that describes this user's running audience server."""
    return Path(jupyter_runtime_dir()) / "slamlab-audience.json"


def _started(wanted, port, state):
    words = [wanted["origin"], "--host", wanted["host"], "--port", str(port), "--state", str(state)]
    child = subprocess.Popen(
        # -P: modules in the folder of the notebook are not imported
        [sys.executable, "-P", "-m", "classroom.audience", *words],
        env={name: os.environ[name] for name in KEPT if name in os.environ},
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,  # interrupting the kernel does not end the server
    )
    with child.stdout, child.stderr:
        line = child.stdout.readline()
        if line:
            return json.loads(line)
        raise RuntimeError(child.stderr.read().strip() or "the audience server ended immediately")


def _running(state):
    try:
        found = json.loads(state.read_text())
        _request(found, "GET", "/alive")
    except (OSError, ValueError, KeyError):  # no file, an old one, or no server
        return None
    return found


def _request(server, method, path):
    here = f"http://127.0.0.1:{server['ports']['lecturer']}"
    request = urllib.request.Request(here + path, method=method)
    request.add_header("Host", urllib.parse.urlsplit(server["control"]).netloc)
    request.add_header("Origin", server["origin"])
    request.add_header("Authorization", f"Bearer {server['key']}")
    direct = urllib.request.build_opener(urllib.request.ProxyHandler({}))
    with direct.open(request, timeout=10) as answer:
        return answer.read()
