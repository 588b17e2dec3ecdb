"""``slamlab check NOTEBOOK``: what the checks say of a notebook as it stands in its file."""

import sys
import textwrap
from pathlib import Path

from slamlab.checks.report import WIDTH, number, points, say


def add_parser(subparsers):
    """Add the command to the command line."""
    parser = subparsers.add_parser(
        "check",
        help="check an exercise notebook",
        description=(
            "Run a notebook's cells in order in a fresh process and all tasks of its exercise on "
            "the functions they define, as grading does, with the inputs that check() uses. Says "
            "what grading would trip over: cells that run only in another order, modules that are "
            "not there, too much time."
        ),
        epilog=(
            "Exit code: 0 when all tasks are passed, 1 when one is not, 2 when the notebook cannot "
            "be checked."
        ),
    )
    parser.add_argument("notebook", metavar="NOTEBOOK", type=Path)
    parser.add_argument(
        "--exercise", metavar="ID", help="where the notebook does not tell it, such as 04 or 4"
    )
    parser.set_defaults(run=run)


def run(arguments) -> int:
    """Check; 0 when all tasks are passed, 1 when one is not, 2 when it cannot be checked."""
    from slamlab.checks import OPEN_SEED, catalogue
    from slamlab.grading import form, judge, submissions
    from slamlab.grading.submissions import Submission, Unreadable
    from slamlab.grading.workers import CannotStart, Workers

    path = arguments.notebook
    try:
        if arguments.exercise is not None:
            catalogue.exercise(arguments.exercise)
        submission = Submission(path.name, path.stem, path)
        notebook = submissions.read(submission)
        exercise = submissions.exercise_of(submission, notebook, arguments.exercise)
        with Workers(warm=False) as workers:
            result = judge.judge(exercise, notebook.cells, OPEN_SEED, workers, tell=True)
    except (Unreadable, CannotStart, KeyError) as error:
        print(f"slamlab check: {path}: {error.args[0]}", file=sys.stderr)
        return 2
    for note in notebook.notes:
        print(f"note: {note}")
    wall = result["seconds"]["wall"]
    for remark in form.remarks(notebook.cells, result["cells"], exercise, wall):
        print(textwrap.fill(remark, WIDTH, subsequent_indent="    "))
    for task, verdict in zip(exercise.tasks, result["verdicts"], strict=True):
        print(say(task, verdict))
    earned = sum(verdict.points for verdict in result["verdicts"])
    print(f"{number(earned)} of {points(exercise.points)}")
    return 0 if all(verdict.full for verdict in result["verdicts"]) else 1
