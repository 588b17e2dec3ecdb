"""``progress.json``: read by the notebook's head and ``slamlab progress``, written by kernels."""

import json
from datetime import datetime
from pathlib import Path

from filelock import FileLock, Timeout

from slamlab.coursework.file_writing import json_bytes, keep_beside, write

NAME = "progress.json"
KINDS = ("tasks", "questions", "validated", "minutes")
EMPTY = {kind: {} for kind in KINDS}
PATIENCE = 5.0  # how long another kernel may hold the file [s]


def read(folder: Path) -> dict:
    """Read the progress; what is not there or not readable counts as nothing done.

    Parameters
    ----------
    folder : Path, of the course

    Returns
    -------
    dict of dicts: ``tasks`` and ``questions`` by id, ``validated`` and ``minutes`` by notebook
    """
    try:
        found = json.loads((folder / NAME).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        found = {}
    if not isinstance(found, dict):
        found = {}
    return {kind: _entries(found.get(kind)) for kind in KINDS}


def change(folder: Path, change, now: datetime) -> bool:
    """Change the progress; several kernels may do so at once, and none is lost.

    A file that cannot be read is kept beside the new one.

    Parameters
    ----------
    folder : Path, of the course
    change : (progress) -> None, called with what :func:`read` returns
    now : datetime, for the name of a file that is kept

    Returns
    -------
    bool, whether it was written; not where the folder cannot be written to
    """
    path = folder / NAME
    try:
        with FileLock(folder / f".{NAME}.lock", timeout=PATIENCE):
            if is_damaged(folder):
                keep_beside(path, now)
            progress = read(folder)
            change(progress)
            write(path, json_bytes(progress))
    except (OSError, Timeout):
        return False
    return True


def is_damaged(folder: Path) -> bool:
    """Whether there is a file of the progress that cannot be read."""
    path = folder / NAME
    try:
        return path.exists() and not isinstance(json.loads(path.read_text("utf-8")), dict)
    except (OSError, ValueError):
        return True


def _entries(found):
    return found if isinstance(found, dict) else {}
