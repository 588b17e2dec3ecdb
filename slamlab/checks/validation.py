"""A notebook as it stands in its file, run in a fresh process and judged as grading judges it."""

import os
import textwrap
from datetime import datetime
from pathlib import Path

from slamlab.checks import OPEN_SEED
from slamlab.checks.report import WIDTH, number, points, say
from slamlab.grading import form, judge, submissions
from slamlab.grading.submissions import Submission, Unreadable
from slamlab.grading.workers import CannotStart, Workers


class NotValidated(Exception):
    """A notebook cannot be judged at all; the text says why."""


def validate(path, default=None) -> bool:
    """Print what grading would say of a notebook, with the inputs that ``check`` uses.

    Parameters
    ----------
    path : Path, of the notebook
    default : str or None, its exercise where it does not tell it

    Returns
    -------
    bool, whether all tasks are passed

    Raises
    ------
    NotValidated
    """
    submission = Submission(path.name, path.stem, path)
    try:
        notebook = submissions.read(submission)
        exercise = submissions.exercise_of(submission, notebook, default)
        with Workers(warm=False) as workers:
            result = judge.judge(exercise, notebook.cells, OPEN_SEED, workers, tell=True)
    except (Unreadable, CannotStart, KeyError) as error:
        raise NotValidated(f"{path}: {error.args[0]}") from None
    for note in notebook.notes:
        print(f"note: {note}")
    wall = result["seconds"]["wall"]
    for remark in form.remarks(notebook.cells, result["cells"], exercise, wall):
        print(textwrap.fill(remark, WIDTH, subsequent_indent="    "))
    for task, verdict in zip(exercise.tasks, result["verdicts"], strict=True):
        print(say(task, verdict))
    earned = sum(verdict.points for verdict in result["verdicts"])
    print(f"{number(earned)} of {points(exercise.points)}")
    return all(verdict.full for verdict in result["verdicts"])


def validate_running(names):
    """Print the same of the notebook whose kernel this is.

    Parameters
    ----------
    names : the notebook's names
    """
    path = _file(names)
    if path is None:
        print(
            "The file of this notebook is not known here, or it was renamed: save it, then Kernel "
            "→ Restart Kernel.\nIn a terminal `slamlab check NOTEBOOK` says the same."
        )
        return
    saved = datetime.fromtimestamp(path.stat().st_mtime)
    print(f"{path.name} as saved at {saved:%H:%M:%S}, in a fresh process from top to bottom:")
    try:
        validate(path)
    except NotValidated as error:
        print(f"✗ {error}")
    except KeyboardInterrupt:
        print("✗ stopped before it was done")


def _file(names):
    """Where the notebook stands, as Jupyter's server or Visual Studio Code tells its kernel."""
    for told in (os.environ.get("JPY_SESSION_NAME"), names.get("__vsc_ipynb_file__")):
        if told and told.endswith(".ipynb"):
            # the server may name it from its own folder on; the kernel stands beside it
            for path in (Path(told), Path(Path(told).name)):
                if path.is_file():
                    return path
    return None
