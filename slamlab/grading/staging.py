"""Staging: copy the whitelist of modules that a worker may import, and link other libraries."""

import functools
import os
import shutil
import sys
from pathlib import Path

from slamlab.grading import checks_stub, hidden_packages
from slamlab.grading.import_closure import STUBBED, closure

WORKER_MODULES = ("slamlab.grading.zygote", "slamlab.grading.worker")


def worker_modules(exercise):
    """The whitelist of modules of a worker, by import closure: name to file."""
    return _closure((STUBBED, exercise.drives, *exercise.allows, *WORKER_MODULES))


_closure = functools.cache(closure)


def copy_modules(copy, exercise):
    """Copy a worker's modules into a folder, readable by everybody.

    Parameters
    ----------
    copy : Path, made
    exercise : Exercise
    """
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
    """The environment variables of a worker: nothing of the judge's own but its language.

    Parameters
    ----------
    home : Path

    Returns
    -------
    dict
    """
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
    """Stage other libraries: the worker's search path, and the paths that it must be able to read.

    Where the course or a hidden package stands among them, a view of the rest is made, of links.
    Without Python's own search (-S) an editable install is not found either.

    Parameters
    ----------
    folder : Path, for the views
    hides : names of packages that the exercise hides

    Returns
    -------
    (list of Path for sys.path, list of Path to read)
    """
    search, readable = [], []
    for path in hidden_packages.library_folders():
        hidden = {entry.name for entry in hidden_packages.entries(path, hides)}
        if hidden and os.name == "posix":  # links need a privilege elsewhere
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
    """The folders that the Python interpreter itself needs to read."""
    system = ["/usr", "/lib", "/lib64", "/lib32", "/etc/ld.so.cache", "/etc/alternatives"]
    found = [Path(p) for p in (*system, sys.base_prefix, sys.base_exec_prefix)]
    return [path for path in dict.fromkeys(found) if path.exists()]
