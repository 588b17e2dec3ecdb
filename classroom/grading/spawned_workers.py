"""Spawned workers without a sandbox, each a new interpreter, on systems without a safe fork."""

import os
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from classroom.grading import staging, tree_removal

POSIX = os.name == "posix"
BOOTSTRAP = (
    "import sys; sys.path.insert(0, sys.argv[2]); sys.path += sys.argv[3:]; "
    "from classroom.grading import worker; worker.main(sys.argv[1])"
)


class SpawnedWorker:
    """A spawned worker, without a sandbox; :attr:`receiving` and :attr:`sending` are the judge's
    ends of its pipes.
    """

    def __init__(self, exercise):
        self.cpu, self._begun = 0.0, time.monotonic()
        self._folder = tempfile.TemporaryDirectory(prefix="slamlab-", ignore_cleanup_errors=True)
        folder = Path(self._folder.name)
        copy, home = folder / "copy", folder / "home"
        staging.copy_modules(copy, exercise)
        home.mkdir()
        search, _ = staging.stage_libraries(folder, exercise.hides)
        options = ["-I", "-S", "-B", "-c", BOOTSTRAP, exercise.calls, copy, *search]
        with open(folder / "errors", "wb") as errors:
            self._process = subprocess.Popen(
                [sys.executable, *options],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=errors,
                cwd=home,
                env=staging.environment(home),
                start_new_session=True,
            )
        self.sending, self.receiving = self._process.stdin, self._process.stdout

    def last_error(self):
        lines = Path(self._folder.name, "errors").read_text("utf-8", "replace").strip().splitlines()
        return lines[-1][:300] if lines else ""

    def cpu_so_far(self):
        """Return the time since the start [s], an upper bound on the CPU time."""
        return time.monotonic() - self._begun

    def kill(self):
        """Kill the worker's process group and store its CPU time [s] in :attr:`cpu`."""
        if self._process.returncode is None:
            if POSIX:
                # before waiting: until then the system cannot give its process id to another
                os.killpg(self._process.pid, signal.SIGKILL)
                _, status, usage = os.wait4(self._process.pid, 0)
                self._process.returncode = os.waitstatus_to_exitcode(status)
                self.cpu = usage.ru_utime + usage.ru_stime
            else:
                self._process.kill()
                self._process.wait()
        tree_removal.remove_tree(self._folder.name)
        self._folder.cleanup()
