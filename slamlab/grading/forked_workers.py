"""Fork server, the judge's end: starts a zygote and asks it for forked workers (Linux)."""

import contextlib
import json
import os
import socket
import subprocess
import sys
import tempfile
from pathlib import Path

from slamlab.grading import bubblewrap, hidden_packages, sandbox, staging, tree_removal

BOOTSTRAP = (
    "import json, sys; plan = json.loads(sys.argv[1]); sys.path[:0] = [plan['copy']]; "
    "sys.path += plan['search']; from slamlab.grading import zygote; "
    "zygote.main(plan['control'], plan)"
)
PRELOADED = ("numpy", "scipy.linalg", "scipy.stats", "scipy.spatial", "sympy", "matplotlib.pyplot")
"""Modules imported before the fork: those that notebooks of the course use."""
# IPython's transformer of magics and shell lines, and how these begin in a notebook's file
MAGICS_MODULE = "IPython.core.inputtransformer2"
_MAGICS = (b'"%', b"\\n%", b'"!', b"\\n!")
START_TIMEOUT, ANSWER_TIMEOUT = 120.0, 20.0  # of the zygote [s]
MAX_MESSAGE_BYTES = 1 << 16  # of a control message [bytes]


class ZygoteError(Exception):
    """The zygote does not start or does not answer; the text is its own last line of errors."""


def named_modules(files):
    """The modules worth importing before the fork: those that some notebook seems to name.

    Parameters
    ----------
    files : iterable of bytes, notebooks; no more are taken than are needed

    Returns
    -------
    tuple of str
    """
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
    """Handle of a fork server: a process with an exercise's imports done, which forks workers.

    One worker at a time. It dies with the thread that started it; only that thread uses it.

    Parameters
    ----------
    exercise : Exercise
    level : str, one of ``sandbox.LEVELS``
    warm : bool, whether to import beforehand at all; worth it for more than one
    preload : names of modules besides those of the exercise

    Raises
    ------
    ZygoteError
    """

    def __init__(self, exercise, level, warm=True, preload=(*PRELOADED, MAGICS_MODULE)):
        self._folder = tempfile.TemporaryDirectory(prefix="slamlab-", ignore_cleanup_errors=True)
        folder = Path(self._folder.name)
        inside, outside = folder / "inside", folder / "errors"
        inside.mkdir(mode=0o755)
        staging.copy_modules(inside / "copy", exercise)
        search, readable = staging.stage_libraries(inside, exercise.hides)
        hidden = hidden_packages.places(staging.python_folders(), exercise.hides)
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
            "drives": exercise.drives,
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
        """Fork a fresh worker.

        Returns
        -------
        ForkedWorker

        Raises
        ------
        ZygoteError
        """
        theirs_in, ours_out = os.pipe()
        ours_in, theirs_out = os.pipe()
        try:
            said = json.dumps({"do": "fork"}).encode()
            socket.send_fds(self._control, [said], [theirs_in, theirs_out])
            self._receive(ANSWER_TIMEOUT)
        except (OSError, ZygoteError):
            os.close(ours_in)
            os.close(ours_out)
            said = self.last_error()
            self.close()
            raise ZygoteError(said) from None
        finally:
            os.close(theirs_in)
            os.close(theirs_out)
        return ForkedWorker(self, os.fdopen(ours_in, "rb"), os.fdopen(ours_out, "wb"))

    def cpu_so_far(self):
        """The CPU time that the worker took so far [s].

        Raises
        ------
        ZygoteError
        """
        try:
            self._control.send(json.dumps({"do": "cpu"}).encode())
        except OSError:
            raise ZygoteError(self.last_error()) from None
        return self._receive(ANSWER_TIMEOUT)["cpu"]

    def kill_worker(self):
        """Kill the worker; its CPU time [s], 0 where the zygote is gone and the worker with it."""
        try:
            self._control.send(json.dumps({"do": "end"}).encode())
            return self._receive(ANSWER_TIMEOUT)["cpu"]
        except (OSError, ZygoteError):
            self.close()
            return 0.0

    def last_error(self):
        """The last line of its error output, "" where there is none."""
        with contextlib.suppress(OSError):
            text = Path(self._folder.name, "errors").read_text("utf-8", "replace")
            return (text.strip().splitlines() or [""])[-1][:300]
        return ""

    @property
    def alive(self):
        """Whether the zygote still runs and can fork workers."""
        return self._process.poll() is None

    def close(self):
        """Terminate the zygote and every worker of its; may be called twice."""
        self._control.close()
        if self._process.poll() is None:
            with contextlib.suppress(subprocess.TimeoutExpired):
                self._process.wait(1.0)  # it ends its workers and itself when nobody listens
        self._process.kill()
        self._process.wait()
        tree_removal.remove_tree(self._folder.name)
        self._folder.cleanup()

    def _receive(self, seconds):
        self._control.settimeout(seconds)
        try:
            said = self._control.recv(MAX_MESSAGE_BYTES)
        except OSError:
            said = b""
        if not said:
            raise ZygoteError(self.last_error() or "the zygote (fork server) does not answer")
        return json.loads(said)


class ForkedWorker:
    """A forked worker; :attr:`receiving` and :attr:`sending` are the judge's ends of its pipes."""

    def __init__(self, zygote, receiving, sending):
        self._zygote, self._runs = zygote, True
        self.receiving, self.sending = receiving, sending
        self.cpu = 0.0

    def last_error(self):
        """The last line of the error output of a worker that could not start."""
        return self._zygote.last_error()

    def cpu_so_far(self):
        """CPU time [s], as the kernel counts it: nothing that runs in the worker can change it."""
        return self._zygote.cpu_so_far() if self._runs else self.cpu

    def kill(self):
        """End the worker; its CPU time [s] is in :attr:`cpu`."""
        if self._runs:
            self.cpu, self._runs = self._zygote.kill_worker(), False
