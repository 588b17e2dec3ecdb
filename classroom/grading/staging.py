"""Staging: copy the modules that a worker may import (whitelist), and link other libraries."""

import functools
import os
import shutil
import sys
from pathlib import Path

from classroom.grading import checks_stub, hidden_packages
from classroom.grading.import_closure import STUBBED, closure

WORKER_MODULES = ("classroom.grading.zygote", "classroom.grading.worker")


def worker_modules(exercise):
    return _closure((STUBBED, exercise.calls, *exercise.allows, *WORKER_MODULES))


_closure = functools.cache(closure)


def copy_modules(copy, exercise):
    """Copy a worker's modules into a new folder that all users can read."""
    for name, file in worker_modules(exercise).items():
        target = Path(copy, *name.split("."))
        if file.name == "__init__.py":
            target = target / "__init__"
        target.parent.mkdir(parents=True, exist_ok=True)
        written = Path(f"{target}.py")
        shutil.copyfile(checks_stub.__file__ if name == STUBBED else file, written)
        written.chmod(0o644)
    for folder in (copy, *(path for path in copy.rglob("*") if path.is_dir())):
        folder.chmod(0o755)


def environment(home):
    """Return a worker's environment variables; only the language is that of the judge."""
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


def stage_libraries(folder, hides=()):
    """Return paths for a worker's sys.path, and readable paths. A library folder with hidden
    packages is replaced by symbolic links in ``folder`` to its other packages. Without Python's
    site module (-S), editable installs are not found either.
    """
    search, readable = [], []
    for path in hidden_packages.library_folders():
        hidden = {entry.name for entry in hidden_packages.entries(path, hides)}
        if hidden and os.name == "posix":  # symbolic links need a privilege on Windows
            view = folder / f"libraries-{len(search)}"
            view.mkdir(mode=0o755)
            others = [entry for entry in path.iterdir() if entry.name not in hidden]
            for entry in others:
                (view / entry.name).symlink_to(entry)
            search.append(view)
            readable += [view, *others]
        else:
            search.append(path)
            readable.append(path)
    return search, readable


def python_folders():
    """Return the folders that the interpreter needs to read."""
    system = ["/usr", "/lib", "/lib64", "/lib32", "/etc/ld.so.cache", "/etc/alternatives"]
    found = [Path(p) for p in (*system, sys.base_prefix, sys.base_exec_prefix)]
    return [path for path in dict.fromkeys(found) if path.exists()]
