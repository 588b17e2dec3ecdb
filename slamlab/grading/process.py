"""Starting a worker: a fresh interpreter on a copy that holds only what its exercise allows."""

import functools
import os
import shutil
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

from slamlab.grading import stub
from slamlab.grading.closure import STUBBED, closure

ISOLATION = "none"
"""A process of its own, nothing more: what a submission may do on this machine is not bounded."""

POSIX = os.name == "posix"
BOOT = (
    "import sys; sys.path.insert(0, sys.argv[2]); sys.path += sys.argv[3:]; "
    "from slamlab.grading import worker; worker.main(sys.argv[1])"
)


def modules(exercise):
    """The modules a worker of an exercise holds, name to file."""
    return _closure((exercise.drives, *exercise.allows, "slamlab.grading.worker"))


_closure = functools.cache(closure)


class Process:
    """A running worker; :attr:`receiving` and :attr:`sending` are its ends of the pipe.

    Parameters
    ----------
    exercise : Exercise
    """

    def __init__(self, exercise):
        self.cpu = 0.0
        self._folder = tempfile.TemporaryDirectory(prefix="slamlab-", ignore_cleanup_errors=True)
        folder = Path(self._folder.name)
        copy, home = folder / "copy", folder / "home"
        _fill(copy, exercise)
        home.mkdir()
        options = ["-I", "-S", "-B", "-c", BOOT, exercise.drives, copy, *_libraries(folder)]
        with open(folder / "errors", "wb") as errors:
            self._process = subprocess.Popen(
                [sys.executable, *options],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=errors,
                cwd=home,
                env=_environment(home),
                start_new_session=True,
            )
        self.sending, self.receiving = self._process.stdin, self._process.stdout

    def errors(self):
        """The last line of a worker that could not even start; not for one that ran a cell."""
        lines = Path(self._folder.name, "errors").read_text("utf-8", "replace").strip().splitlines()
        return lines[-1][:300] if lines else ""

    def kill(self):
        """End the worker and all processes of its group; its CPU time [s] is in :attr:`cpu`."""
        if self._process.returncode is None:
            if POSIX:
                # before it is waited for: until then its number cannot be another's
                os.killpg(self._process.pid, signal.SIGKILL)
                _, status, usage = os.wait4(self._process.pid, 0)
                self._process.returncode = os.waitstatus_to_exitcode(status)
                self.cpu = usage.ru_utime + usage.ru_stime
            else:
                self._process.kill()
                self._process.wait()
        self._folder.cleanup()


def _fill(copy, exercise):
    for name, file in modules(exercise).items():
        target = Path(copy, *name.split("."))
        if file.name == "__init__.py":
            target = target / "__init__"
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(stub.__file__ if name == STUBBED else file, f"{target}.py")


def _environment(home):
    kept = {name: os.environ[name] for name in ("SYSTEMROOT", "LANG") if name in os.environ}
    return kept | {
        "HOME": str(home),
        "TMPDIR": str(home),
        "MPLCONFIGDIR": str(home),
        "MPLBACKEND": "Agg",
        "OPENBLAS_NUM_THREADS": "1",
        "OMP_NUM_THREADS": "1",
        "PYTHONUTF8": "1",
    }


def _libraries(folder):
    """The folders other libraries stand in; where the package itself stands in one, a view of it.

    Without Python's own search (-S) an editable install is not found either.
    """
    found = []
    for place in dict.fromkeys(sys.path):
        path = Path(place)
        if path.name not in ("site-packages", "dist-packages") or not path.is_dir():
            continue
        if (path / "slamlab").exists() and POSIX:  # links need a privilege elsewhere
            view = folder / f"libraries-{len(found)}"
            view.mkdir()
            for entry in path.iterdir():
                if not entry.name.startswith("slamlab"):
                    (view / entry.name).symlink_to(entry)
            path = view
        found.append(path)
    return found
