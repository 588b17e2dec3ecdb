"""Workers forked from a zygote: the judge's end (Linux)."""

import contextlib
import json
import os
import socket
import subprocess
import sys
import tempfile
from pathlib import Path

from slamlab.grading import bubblewrap, jail, place

BOOT = (
    "import json, sys; plan = json.loads(sys.argv[1]); sys.path[:0] = [plan['copy']]; "
    "sys.path += plan['search']; from slamlab.grading import zygote; "
    "zygote.main(plan['control'], plan)"
)
COURSE = ("numpy", "scipy.linalg", "scipy.stats", "scipy.spatial", "sympy", "matplotlib.pyplot")
"""What notebooks of the course import, and what shell lines in one need."""
MAGICS = "IPython.core.inputtransformer2"
START_SECONDS, ANSWER_SECONDS = 120.0, 20.0
LONGEST = 1 << 16


class Broken(Exception):
    """The zygote does not come up or does not answer; the text is its own last line."""


class Zygote:
    """A process with an exercise's imports done, from which workers are forked, one at a time.

    It dies with the thread that started it; only that thread uses it.

    Parameters
    ----------
    exercise : Exercise
    level : str, one of ``jail.LEVELS``
    warm : bool, whether to import what notebooks usually do; worth it for more than one

    Raises
    ------
    Broken
    """

    def __init__(self, exercise, level, warm=True):
        self._folder = tempfile.TemporaryDirectory(prefix="slamlab-", ignore_cleanup_errors=True)
        folder = Path(self._folder.name)
        inside, outside = folder / "inside", folder / "errors"
        inside.mkdir(mode=0o755)
        place.fill(inside / "copy", exercise)
        search, readable = place.libraries(inside)
        home = inside / "home"
        home.mkdir()
        self._control, control = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        plan = {
            "control": control.fileno(),
            "copy": str(inside / "copy"),
            "search": [str(path) for path in search],
            "readable": [
                str(path) for path in (inside / "copy", *readable, *place.python_folders())
            ],
            "home": str(home),
            "drives": exercise.drives,
            "preload": [*COURSE, MAGICS, *exercise.allows] if warm else [],
            "level": level,
            "drop": level == jail.STRICT and bubblewrap.drops_root(),
        }
        python = Path(sys._base_executable or sys.executable).resolve()
        words = [str(python), "-I", "-S", "-B", "-c", BOOT, json.dumps(plan)]
        if level == jail.STRICT:
            words = bubblewrap.command(inside, home, python) + words
        with open(outside, "wb") as errors:
            self._process = subprocess.Popen(
                words,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=errors,
                env=place.environment(home),
                pass_fds=[control.fileno()],
                start_new_session=True,
            )
        control.close()
        self._hear(START_SECONDS)

    def fork(self):
        """A fresh worker.

        Returns
        -------
        Forked

        Raises
        ------
        Broken
        """
        theirs_in, ours_out = os.pipe()
        ours_in, theirs_out = os.pipe()
        try:
            said = json.dumps({"do": "fork"}).encode()
            socket.send_fds(self._control, [said], [theirs_in, theirs_out])
            self._hear(ANSWER_SECONDS)
        except (OSError, Broken):
            os.close(ours_in)
            os.close(ours_out)
            said = self.errors()
            self.close()
            raise Broken(said) from None
        finally:
            os.close(theirs_in)
            os.close(theirs_out)
        return Forked(self, os.fdopen(ours_in, "rb"), os.fdopen(ours_out, "wb"))

    def end(self):
        """Kill the worker; its CPU time [s], 0 where the zygote is gone and the worker with it."""
        try:
            self._control.send(json.dumps({"do": "end"}).encode())
            return self._hear(ANSWER_SECONDS)["cpu"]
        except (OSError, Broken):
            self.close()
            return 0.0

    def errors(self):
        """The last line it wrote of what went wrong."""
        with contextlib.suppress(OSError):
            text = Path(self._folder.name, "errors").read_text("utf-8", "replace")
            return (text.strip().splitlines() or [""])[-1][:300]
        return ""

    @property
    def alive(self):
        """bool, whether workers can still come of it."""
        return self._process.poll() is None

    def close(self):
        """End the zygote and every worker of its; may be called twice."""
        self._control.close()
        if self._process.poll() is None:
            with contextlib.suppress(subprocess.TimeoutExpired):
                self._process.wait(1.0)  # it ends its workers and itself when nobody listens
        self._process.kill()
        self._process.wait()
        self._folder.cleanup()

    def _hear(self, seconds):
        self._control.settimeout(seconds)
        try:
            said = self._control.recv(LONGEST)
        except OSError:
            said = b""
        if not said:
            raise Broken(self.errors() or "the process that starts workers does not answer")
        return json.loads(said)


class Forked:
    """A running worker; :attr:`receiving` and :attr:`sending` are the judge's ends of its pipes."""

    def __init__(self, zygote, receiving, sending):
        self._zygote, self._runs = zygote, True
        self.receiving, self.sending = receiving, sending
        self.cpu = 0.0

    def errors(self):
        """The last line of a worker that could not even start."""
        return self._zygote.errors()

    def kill(self):
        """End the worker; its CPU time [s] is in :attr:`cpu`."""
        if self._runs:
            self.cpu, self._runs = self._zygote.end(), False
