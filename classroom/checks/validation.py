"""Validate a notebook: run its file in a fresh process and judge it as grading does."""

import textwrap
from datetime import datetime

from classroom.checks.notebook_file import notebook_file, unsaved_definitions
from classroom.coursework import progress_records
from classroom.exercises.task import OPEN_SEED
from classroom.exercises.verdict_text import WIDTH, coloured, format_verdict, number, points
from classroom.grading import judge, preflight, submissions
from classroom.grading.submissions import Submission, SubmissionError
from classroom.grading.worker_pool import WorkerPool, WorkerStartError

UNPACKED = 1980  # the year of all files in a pack, the earliest year of a zip


class ValidationError(Exception):
    """A notebook cannot be validated; the message states the reason."""


def validate(path, default=None, keep=False) -> bool:
    """Validate a file with the open seed, print verdicts, and return whether all tasks pass.

    default : exercise to use if the notebook names none. keep : whether to record the points in
    the progress. Raises ValidationError."""
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
    for remark in preflight.form_warnings(result["cells"], wall):
        print(textwrap.fill(remark, WIDTH, subsequent_indent="    "))
    for task, verdict in zip(exercise.tasks, result["verdicts"], strict=True):
        print(coloured(format_verdict(task, verdict)))
        if verdict.laws and not verdict.full:
            print(f'    hint("{task.id}") in the notebook asks a question about it.')
    earned = sum(verdict.points for verdict in result["verdicts"])
    print(f"{number(earned)} of {points(exercise.points)}")
    if keep:
        progress_records.record_validation(exercise.id, float(earned), float(exercise.points))
    return all(verdict.full for verdict in result["verdicts"])


def _saved(path):
    saved = datetime.fromtimestamp(path.stat().st_mtime)
    if saved.year <= UNPACKED:
        return "as it was handed out"
    is_today = saved.date() == datetime.now().date()
    return f"as saved at {saved:%H:%M:%S}" if is_today else f"as saved on {saved:%Y-%m-%d at %H:%M}"


def validate_current_notebook(names):
    path = notebook_file(names)
    if path is None:
        print(
            "The file of this notebook was not found. Save the notebook in the folder of the other "
            "exercises\nand run all cells from the top. If you renamed the notebook, first restart "
            "its kernel.\nIn a terminal, `slamlab check NOTEBOOK` prints the same report."
        )
        return
    for name in unsaved_definitions(path, names):
        print(f"Your last version of {name} is not saved. Save (Ctrl+S), then run this cell again.")
    print(f"{path.name} {_saved(path)}, run in a fresh process from top to bottom:")
    try:
        validate(path, keep=True)
    except ValidationError as error:
        print(f"✗ {error}")
    except KeyboardInterrupt:
        print("✗ stopped before the validation was finished")
