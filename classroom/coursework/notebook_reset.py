"""Reset an exercise, a lesson or a task's cells to the handed-out version, with a backup."""

import json
import re
from datetime import datetime
from pathlib import Path

from classroom.coursework import originals
from classroom.coursework.file_writing import back_up_beside, json_bytes, write
from classroom.coursework.originals import OriginalError

_TASK = re.compile(r"(\d\d)-[a-z0-9-]+")
_NUMBER = re.compile(r"(ex|lesson-?)?(\d{1,2})", re.IGNORECASE)


class ResetError(Exception):
    """Nothing was reset; the message states the reason and a remedy."""


def reset(folder: Path, what: str, now: datetime) -> list[str]:
    """Reset an exercise (04), a lesson (lesson-04), a task (04-h-robot) or the notebook at a path.

    Save a copy of the student's notebook first. Return messages about what was done. Raises
    ResetError."""
    try:
        name, task = _name(folder, what)
        handed_out, path = originals.original(folder, name), folder / name
        if task:
            if not path.is_file():
                raise ResetError(f"{name} does not exist: slamlab reset {task[:2]} restores it")
            new = _with_task_reset(path, handed_out, task)
        else:
            new = handed_out
        if path.is_file() and path.read_bytes() == new:
            return [f"{name} equals the handed-out version: nothing to reset"]
        backup = []
        if path.exists():
            backup = [f"your version is saved as {back_up_beside(path, now).relative_to(folder)}"]
        write(path, new)
    except OriginalError as error:
        raise ResetError(str(error)) from None
    except OSError as error:
        raise ResetError(f"{error.filename or folder}: {error.strerror or error}") from None
    of = f"the cells of {task} in {name} were" if task else f"{name} was"
    reload = "if the notebook is open, choose File → Reload Notebook from Disk"
    return [f"{of} reset to the handed-out version", *backup, reload]


def _name(folder, what):
    known = originals.names(folder)
    task = _TASK.fullmatch(what)
    number = _NUMBER.fullmatch(what)
    if task:
        pattern = rf"exercises/ex{task[1]}_.*"
    elif number:
        lesson = (number[1] or "").lower().startswith("lesson")
        kind = "notebooks/" if lesson or int(number[2]) == 0 else "exercises/ex"
        pattern = rf"{kind}{number[2].zfill(2)}_.*"
    else:
        pattern = re.escape(_relative(folder, what))
    found = [name for name in known if re.fullmatch(pattern, name)]
    if not found:
        raise ResetError(
            f"no notebook {what!r} was handed out: give an exercise such as 04, a lesson such as "
            "lesson-04, a task such as 04-h-robot, or the path of a notebook with its original name"
        )
    return found[0], what if task else None


def _relative(folder, what):
    path = Path(what).resolve()
    return path.relative_to(folder).as_posix() if path.is_relative_to(folder) else what


def _with_task_reset(path, handed_out, task):
    cells = json.loads(handed_out)["cells"]
    wanted = task_cells(cells, task)
    if not wanted:
        known = [cell["id"] for cell in cells if _TASK.fullmatch(cell["id"])]
        raise ResetError(f"no task {task!r} in {path.name}: its tasks are {', '.join(known)}")
    try:
        notebook = json.loads(path.read_text(encoding="utf-8"))
        own = notebook["cells"]
        index = {cell.get("id"): k for k, cell in enumerate(own)}
    except (ValueError, KeyError, TypeError, AttributeError):
        raise ResetError(
            f"{path.name} cannot be read: slamlab reset {task[:2]} resets the whole notebook"
        ) from None
    check = next(cell for cell in cells if cell["id"] == task)  # without the old verdict
    for cell in (*wanted, check):
        if cell["id"] in index:
            own[index[cell["id"]]] = cell
    for cell in wanted:
        if cell["id"] not in index:  # a deleted cell is inserted before its check
            check = [k for k, each in enumerate(own) if each.get("id") == task]
            own.insert(check[0] if check else len(own), cell)
    return json_bytes(notebook)


def task_cells(cells, task):
    """Return the cells that students fill in between the previous check and the task's check.

    A milestone, which has no such cells, is solved in the cells of the previous task."""
    found, before = [], []
    for cell in cells:
        graded = cell["metadata"].get("nbgrader", {})
        if graded.get("solution"):
            found.append(cell)
        elif graded.get("grade"):
            found = found or before
            if graded["grade_id"] == task:
                return found
            found, before = [], found
    return []
