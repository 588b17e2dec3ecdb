"""Read and write ``progress.json`` under a file lock, because several kernels may write it."""

import json
from datetime import datetime
from pathlib import Path

from filelock import FileLock, Timeout

from classroom.coursework.file_writing import back_up_beside, json_bytes, write

NAME = "progress.json"
KINDS = ("tasks", "questions", "validated", "minutes")
EMPTY = {kind: {} for kind in KINDS}
PATIENCE = 5.0  # how long to wait for the lock of another kernel [s]


def read(folder: Path) -> dict:
    """Read the progress; unreadable entries count as empty.

    ``tasks`` and ``questions`` are indexed by id, ``validated`` and ``minutes`` by notebook."""
    try:
        found = json.loads((folder / NAME).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        found = {}
    if not isinstance(found, dict):
        found = {}
    return {kind: _entries(found.get(kind)) for kind in KINDS}


def change(folder: Path, change, now: datetime) -> bool:
    """Change the progress by calling ``change(progress)`` under a lock.

    Save a copy of an unreadable file first. Return False if nothing can be written."""
    path = folder / NAME
    try:
        with FileLock(folder / f".{NAME}.lock", timeout=PATIENCE):
            if is_damaged(folder):
                back_up_beside(path, now)
            progress = read(folder)
            change(progress)
            write(path, json_bytes(progress))
    except (OSError, Timeout):
        return False
    return True


def is_damaged(folder: Path) -> bool:
    path = folder / NAME
    try:
        return path.exists() and not isinstance(json.loads(path.read_text("utf-8")), dict)
    except (OSError, ValueError):
        return True


def _entries(found):
    return found if isinstance(found, dict) else {}
