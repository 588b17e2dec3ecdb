"""Reset: an exercise, a lesson or one task's cells as they were handed out; the old form stays."""

import json
import re
from datetime import datetime
from pathlib import Path

from slamlab.coursework import originals
from slamlab.coursework.file_writing import json_bytes, keep_beside, write
from slamlab.coursework.originals import OriginalError

_TASK = re.compile(r"(\d\d)-[a-z0-9-]+")
_NUMBER = re.compile(r"(ex|lesson-?)?(\d{1,2})", re.IGNORECASE)


class ResetError(Exception):
    """Nothing was reset; the text says why and what to do."""


def reset(folder: Path, what: str, now: datetime) -> list[str]:
    """Reset an exercise (04), a lesson (lesson-04) or a task (04-h-robot) to its handed-out form.

    What stood there is kept beside it, with the date in its name; it is written before anything
    is changed.

    Parameters
    ----------
    folder : Path, of the course
    what : str; a path of a notebook does as well
    now : datetime

    Returns
    -------
    list of str, what was done

    Raises
    ------
    ResetError : there is no such thing, or it cannot be read or written
    """
    try:
        name, task = _name(folder, what)
        handed_out, path = originals.original(folder, name), folder / name
        if task:
            if not path.is_file():
                raise ResetError(f"{name} is not there: slamlab reset {task[:2]} brings it back")
            new = _with_task_reset(path, handed_out, task)
        else:
            new = handed_out
        if path.is_file() and path.read_bytes() == new:
            return [f"{name} is as it was handed out: nothing to reset"]
        told = []
        if path.exists():
            told = [f"what stood there is now {keep_beside(path, now).relative_to(folder)}"]
        write(path, new)
    except OriginalError as error:
        raise ResetError(str(error)) from None
    except OSError as error:
        raise ResetError(f"{error.filename or folder}: {error.strerror or error}") from None
    of = f"the cells of {task} in {name} are" if task else f"{name} is"
    return [f"{of} as handed out", *told, "is it open? File → Reload Notebook from Disk"]


def _name(folder, what):
    """The notebook's name, and the task where only one is meant."""
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
            "lesson-04, a task such as 04-h-robot, or the path of a notebook under its first name"
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
        raise ResetError(f"no task {task!r} in {path.name}, which has {', '.join(known)}")
    try:
        notebook = json.loads(path.read_text(encoding="utf-8"))
        own = notebook["cells"]
        places = {cell.get("id"): place for place, cell in enumerate(own)}
    except (ValueError, KeyError, TypeError, AttributeError):
        raise ResetError(
            f"{path.name} is no readable notebook: slamlab reset {task[:2]} resets all of it"
        ) from None
    check = next(cell for cell in cells if cell["id"] == task)  # what it said is of the old answer
    for cell in (*wanted, check):
        if cell["id"] in places:
            own[places[cell["id"]]] = cell
    for cell in wanted:
        if cell["id"] not in places:  # deleted: it comes back in front of its check
            check = [place for place, each in enumerate(own) if each.get("id") == task]
            own.insert(check[0] if check else len(own), cell)
    return json_bytes(notebook)


def task_cells(cells, task):
    """The cells with a task's solution: those to fill in between the check before and its own.

    A task without such cells is solved in those of the task before, as milestones are.
    """
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
