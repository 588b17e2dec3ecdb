"""Validate a notebook: run its file in a fresh process and judge it as grading will."""

import textwrap
from datetime import datetime

from slamlab.checks.notebook_file import notebook_file, unsaved_definitions
from slamlab.coursework import progress_records
from slamlab.exercises.report import WIDTH, coloured, format_verdict, number, points
from slamlab.exercises.task import OPEN_SEED
from slamlab.grading import judge, preflight, submissions
from slamlab.grading.submissions import Submission, SubmissionError
from slamlab.grading.worker_pool import WorkerPool, WorkerStartError

UNPACKED = 1980  # the year of all files in a pack, the earliest that a zip can hold


class ValidationError(Exception):
    """A notebook cannot be validated at all; the text says why."""


def validate(path, default=None, keep=False) -> bool:
    """Validate a notebook and print its verdicts, with the inputs (open seed) that ``check`` uses.

    Parameters
    ----------
    path : Path, of the notebook
    default : str or None, its exercise where it does not tell it
    keep : bool, whether the points go into the progress

    Returns
    -------
    bool, whether all tasks are passed

    Raises
    ------
    ValidationError
    """
    submission = Submission(path.name, path.stem, path)
    try:
        notebook = submissions.read_notebook(submission)
        exercise = submissions.identify_exercise(submission, notebook, default)
        with WorkerPool(warm=False) as workers:
            result = judge.judge_notebook(
                exercise, notebook.cells, OPEN_SEED, workers, unredacted=True
            )
    except (SubmissionError, WorkerStartError, KeyError) as error:
        raise ValidationError(f"{path}: {error.args[0]}") from None
    for note in notebook.notes:
        print(f"note: {note}")
    wall = result["seconds"]["wall"]
    for remark in preflight.form_warnings(notebook.cells, result["cells"], exercise, wall):
        print(textwrap.fill(remark, WIDTH, subsequent_indent="    "))
    for task, verdict in zip(exercise.tasks, result["verdicts"], strict=True):
        print(coloured(format_verdict(task, verdict)))
    earned = sum(verdict.points for verdict in result["verdicts"])
    print(f"{number(earned)} of {points(exercise.points)}")
    if keep:
        progress_records.keep_validation(exercise.id, float(earned), float(exercise.points))
    return all(verdict.full for verdict in result["verdicts"])


def _saved(path):
    """When a file was saved: the time, of another day with its date; a pack's files have none."""
    saved = datetime.fromtimestamp(path.stat().st_mtime)
    if saved.year <= UNPACKED:
        return "as it was handed out"
    is_today = saved.date() == datetime.now().date()
    return f"as saved at {saved:%H:%M:%S}" if is_today else f"as saved on {saved:%Y-%m-%d at %H:%M}"


def validate_current_notebook(names):
    """Validate the notebook whose kernel this is.

    Parameters
    ----------
    names : the notebook's names
    """
    path = notebook_file(names)
    if path is None:
        print(
            "Which file this notebook is, is not known here: save it beside the other exercises "
            "and run its\ncells from the top, then this one. If it has a new name, restart its "
            "kernel first.\nIn a terminal `slamlab check NOTEBOOK` says the same."
        )
        return
    for name in unsaved_definitions(path, names):
        print(f"not saved: {name} as you ran it last; save (Ctrl+S), then run this cell again")
    print(f"{path.name} {_saved(path)}, in a fresh process from top to bottom:")
    try:
        validate(path, keep=True)
    except ValidationError as error:
        print(f"✗ {error}")
    except KeyboardInterrupt:
        print("✗ stopped before it was done")
