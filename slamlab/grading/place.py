"""What a worker gets to see: a copy of the modules its exercise allows, and other libraries."""

import functools
import os
import shutil
import sys
from pathlib import Path

from slamlab.grading import stub
from slamlab.grading.closure import STUBBED, closure

WORKER = ("slamlab.grading.zygote", "slamlab.grading.worker")
PACKAGES = ("site-packages", "dist-packages")


def modules(exercise):
    """The modules a worker of an exercise holds, name to file."""
    return _closure((exercise.drives, *exercise.allows, *WORKER))


_closure = functools.cache(closure)


def fill(copy, exercise):
    """Copy these modules into a folder, readable by everybody.

    Parameters
    ----------
    copy : Path, made
    exercise : Exercise
    """
    for name, file in modules(exercise).items():
        target = Path(copy, *name.split("."))
        if file.name == "__init__.py":
            target = target / "__init__"
        target.parent.mkdir(parents=True, exist_ok=True)
        written = Path(f"{target}.py")
        shutil.copyfile(stub.__file__ if name == STUBBED else file, written)
        written.chmod(0o644)
    for folder in (copy, *(path for path in copy.rglob("*") if path.is_dir())):
        folder.chmod(0o755)


def environment(home):
    """The variables of a worker: nothing of the judge's own but its language.

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


def library_folders():
    """The folders that other libraries stand in."""
    places = (Path(place) for place in dict.fromkeys(sys.path))
    return [path for path in places if path.name in PACKAGES and path.is_dir()]


def own(folder):
    """What belongs to this package in a folder of libraries: the worker must not see it."""
    return [entry for entry in folder.iterdir() if "slamlab" in entry.name.lower()]


def libraries(folder):
    """Where a worker finds other libraries, and the paths that it has to be able to read.

    Where the package itself stands among them, a view of the rest is made, of links. Without
    Python's own search (-S) an editable install is not found either.

    Parameters
    ----------
    folder : Path, for the views

    Returns
    -------
    (list of Path for sys.path, list of Path to read)
    """
    search, readable = [], []
    for path in library_folders():
        if own(path) and os.name == "posix":  # links need a privilege elsewhere
            hidden = {entry.name for entry in own(path)}
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
    """What Python itself needs to be able to read."""
    system = ["/usr", "/lib", "/lib64", "/lib32", "/etc/ld.so.cache", "/etc/alternatives"]
    found = [Path(p) for p in (*system, sys.base_prefix, sys.base_exec_prefix)]
    return [path for path in dict.fromkeys(found) if path.exists()]
