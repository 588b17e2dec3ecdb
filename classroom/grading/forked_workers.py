"""Fork server, judge's side: start a zygote and request forked workers from it (Linux)."""

import contextlib
import json
import os
import socket
import subprocess
import sys
import tempfile
from pathlib import Path

from classroom.grading import bubblewrap, hidden_packages, sandbox, staging, tree_removal

BOOTSTRAP = (
    "import json, sys; plan = json.loads(sys.argv[1]); sys.path[:0] = [plan['copy']]; "
    "sys.path += plan['search']; from classroom.grading import zygote; "
    "zygote.main(plan['control'], plan)"
)
PRELOADED = ("numpy", "scipy.linalg", "scipy.stats", "scipy.spatial", "sympy", "matplotlib.pyplot")
"""Modules that the course's notebooks use, imported before the fork."""
# IPython's transformer of magics and shell lines, and their beginnings in a notebook file
MAGICS_MODULE = "IPython.core.inputtransformer2"
_MAGICS = (b'"%', b"\\n%", b'"!', b"\\n!")
START_TIMEOUT, ANSWER_TIMEOUT = 120.0, 20.0  # of the zygote [s]
MAX_MESSAGE_BYTES = 1 << 16  # of a control message [bytes]


class ZygoteError(Exception):
    """The zygote does not start or respond; the message is the last line of its error output."""


def modules_to_preload(files):
    """Return the modules that a notebook (bytes) seems to use, to import them before the fork."""
    missing, found = {*PRELOADED, MAGICS_MODULE}, []
    for data in files:
        new = [name for name in missing if _is_named(name, data)]
        found += new
        missing.difference_update(new)
        if not missing:
            break
    return tuple(sorted(found))


def _is_named(name, data):
    if name == MAGICS_MODULE:
        return any(begin in data for begin in _MAGICS)
    return all(part.encode() in data for part in name.split("."))


class Zygote:
    """Handle of a fork server, which forks one worker at a time. Only the thread that starts the
    server may use it, and the server ends with that thread. If ``warm``, the server first imports
    ``preload``. Raises ZygoteError.
    """

    def __init__(self, exercise, level, warm=True, preload=(*PRELOADED, MAGICS_MODULE)):
        self._folder = tempfile.TemporaryDirectory(prefix="slamlab-", ignore_cleanup_errors=True)
        folder = Path(self._folder.name)
        inside, outside = folder / "inside", folder / "errors"
        inside.mkdir(mode=0o755)
        staging.copy_modules(inside / "copy", exercise)
        search, readable = staging.stage_libraries(inside, exercise.hides)
        hidden = hidden_packages.hidden_paths(staging.python_folders(), exercise.hides)
        listed = []
        for path in staging.python_folders():
            read, names_only = hidden_packages.readable_around(path, hidden)
            readable, listed = readable + read, listed + names_only
        home = inside / "home"
        home.mkdir()
        self._control, control = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        plan = {
            "control": control.fileno(),
            "copy": str(inside / "copy"),
            "search": [str(path) for path in search],
            "readable": [str(path) for path in (inside / "copy", *readable)],
            "listed": [str(path) for path in listed],
            "home": str(home),
            "calls": exercise.calls,
            "preload": [*preload, *exercise.allows] if warm else [],
            "level": level,
            "drop": level == sandbox.STRICT and bubblewrap.drops_privileges(),
        }
        python = Path(sys._base_executable or sys.executable).resolve()
        words = [str(python), "-I", "-S", "-B", "-c", BOOTSTRAP, json.dumps(plan)]
        if level == sandbox.STRICT:
            words = bubblewrap.command(inside, home, python, hidden) + words
        with open(outside, "wb") as errors:
            self._process = subprocess.Popen(
                words,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=errors,
                env=staging.environment(home),
                pass_fds=[control.fileno()],
                start_new_session=True,
            )
        control.close()
        self._receive(START_TIMEOUT)

    def fork(self):
        theirs_in, ours_out = os.pipe()
        ours_in, theirs_out = os.pipe()
        try:
            request = json.dumps({"do": "fork"}).encode()
            socket.send_fds(self._control, [request], [theirs_in, theirs_out])
            self._receive(ANSWER_TIMEOUT)
        except (OSError, ZygoteError):
            os.close(ours_in)
            os.close(ours_out)
            message = self.last_error()
            self.close()
            raise ZygoteError(message) from None
        finally:
            os.close(theirs_in)
            os.close(theirs_out)
        return ForkedWorker(self, os.fdopen(ours_in, "rb"), os.fdopen(ours_out, "wb"))

    def cpu_so_far(self):
        """Return the worker's CPU time [s]."""
        try:
            self._control.send(json.dumps({"do": "cpu"}).encode())
        except OSError:
            raise ZygoteError(self.last_error()) from None
        return self._receive(ANSWER_TIMEOUT)["cpu"]

    def kill_worker(self):
        """Kill the worker; return its CPU time [s], or 0 if the zygote has also ended."""
        try:
            self._control.send(json.dumps({"do": "end"}).encode())
            return self._receive(ANSWER_TIMEOUT)["cpu"]
        except (OSError, ZygoteError):
            self.close()
            return 0.0

    def last_error(self):
        with contextlib.suppress(OSError):
            text = Path(self._folder.name, "errors").read_text("utf-8", "replace")
            return (text.strip().splitlines() or [""])[-1][:300]
        return ""

    @property
    def alive(self):
        return self._process.poll() is None

    def close(self):
        """End the fork server and its worker; a second call has no effect."""
        self._control.close()
        if self._process.poll() is None:
            with contextlib.suppress(subprocess.TimeoutExpired):
                self._process.wait(1.0)  # it ends itself and its worker when the socket closes
        self._process.kill()
        self._process.wait()
        tree_removal.remove_tree(self._folder.name)
        self._folder.cleanup()

    def _receive(self, seconds):
        self._control.settimeout(seconds)
        try:
            message = self._control.recv(MAX_MESSAGE_BYTES)
        except OSError:
            message = b""
        if not message:
            raise ZygoteError(self.last_error() or "the zygote (fork server) does not respond")
        return json.loads(message)


class ForkedWorker:
    """A forked worker; :attr:`receiving` and :attr:`sending` are the judge's ends of its pipes."""

    def __init__(self, zygote, receiving, sending):
        self._zygote, self._runs = zygote, True
        self.receiving, self.sending = receiving, sending
        self.cpu = 0.0

    def last_error(self):
        return self._zygote.last_error()

    def cpu_so_far(self):
        """Return the CPU time [s] measured by the kernel; the worker cannot change it."""
        return self._zygote.cpu_so_far() if self._runs else self.cpu

    def kill(self):
        """Kill the worker and store its CPU time [s] in :attr:`cpu`."""
        if self._runs:
            self.cpu, self._runs = self._zygote.kill_worker(), False
