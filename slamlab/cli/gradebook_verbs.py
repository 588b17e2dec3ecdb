"""``slamlab grade merge``, ``adjust``, ``export``: merge gradebooks, override points, export."""

import sys
from dataclasses import replace
from pathlib import Path

VERBS = ("merge", "adjust", "export")


def add_parser(subparsers):
    """Add the commands to the command line; they are words behind ``grade``."""
    merge = _parser(subparsers, "merge", "Put the gradebooks of several runs into one.")
    merge.add_argument("books", metavar="BOOK", nargs="+", help="URL, or folder of results")
    adjust = _parser(
        subparsers, "adjust", "Override the points of a task by hand; the judge's stay."
    )
    adjust.add_argument("submission", metavar="SUBMISSION", help="as in grades.csv")
    adjust.add_argument("task", metavar="TASK", help="such as 04-h-robot")
    adjust.add_argument("points", metavar="POINTS", type=float)
    adjust.add_argument("--reason", metavar="TEXT", required=True, help="stands in the table")
    export = _parser(subparsers, "export", "Write marks where another program keeps them.")
    export.add_argument(
        "--nbgrader-gradebook",
        metavar="URL",
        required=True,
        help="nbgrader's database, such as sqlite:///gradebook.db",
    )


def _parser(subparsers, verb, says):
    parser = subparsers.add_parser(f"grade {verb}", description=says)
    parser.add_argument("--out", metavar="DIR", type=Path, required=True, help="results, written")
    parser.add_argument("--db", metavar="URL", help="the gradebook; default: DIR/grades.db")
    parser.add_argument(
        "--policy", metavar="FILE", type=Path, help="late policy (due dates, penalty)"
    )
    parser.set_defaults(run=run, verb=verb)
    return parser


def run(arguments) -> int:
    """Merge, override or export; 0 when done, 2 for wrong use."""
    from slamlab.grading import late_policy
    from slamlab.grading.gradebook import Gradebook, GradebookError, default_url
    from slamlab.grading.nbgrader_gradebook import NbgraderError

    verb = {"merge": _merge, "adjust": _adjust, "export": _export}[arguments.verb]
    try:
        policy = late_policy.load(arguments.policy) if arguments.policy else None
        if arguments.verb == "merge":
            arguments.out.mkdir(parents=True, exist_ok=True)
        with Gradebook(
            arguments.db or default_url(arguments.out, arguments.verb == "merge")
        ) as book:
            print(verb(arguments, book, policy))
    except (GradebookError, NbgraderError, late_policy.LatePolicyError, KeyError) as error:
        print(f"slamlab grade {arguments.verb}: {error.args[0]}", file=sys.stderr)
        return 2
    except OSError as error:
        print(
            f"slamlab grade {arguments.verb}: {error.filename}: {error.strerror}", file=sys.stderr
        )
        return 2
    return 0


def _merge(arguments, book, policy):
    from slamlab.grading.gradebook import Gradebook, default_url

    added = 0
    for name in arguments.books:
        with Gradebook(name if "://" in name else default_url(Path(name), new=False)) as other:
            added += book.merge(other)
    count = _write(arguments, book, policy)
    return f"{added} attempts added; {count} submissions: {arguments.out / 'grades.csv'}"


def _adjust(arguments, book, policy):
    from slamlab.exercises import catalogue

    task = catalogue.task(arguments.task)
    known = {record.submission: record for record in book.latest_attempts()}
    if arguments.submission not in known:
        raise KeyError(f"no submission {arguments.submission!r} in the gradebook; see grades.csv")
    exercise = known[arguments.submission].exercise
    if exercise not in (None, arguments.task[:2]):
        raise KeyError(f"{arguments.submission} is of exercise {exercise}, {arguments.task} is not")
    if not 0 <= arguments.points <= task.points:
        raise KeyError(
            f"{arguments.task} has 0 to {task.points:g} points, not {arguments.points:g}"
        )
    book.override_points(
        arguments.submission, arguments.task[:2], arguments.task, arguments.points, arguments.reason
    )
    _write(arguments, book, policy)
    return f"{arguments.submission}: {arguments.task} set to {arguments.points:g}"


def _export(arguments, book, policy):
    from slamlab.grading import nbgrader_gradebook

    count = nbgrader_gradebook.export(_marks(book, policy), arguments.nbgrader_gradebook)
    return f"{count} submissions written to {arguments.nbgrader_gradebook}"


def _marks(book, policy):
    from slamlab.grading.marks import mark

    if policy is not None:
        for record in book.latest_attempts():
            book.add(replace(record, policy=policy.stored(record.student)))
    overrides = book.overrides()
    return [mark(record, overrides) for record in book.latest_attempts()]


def _write(arguments, book, policy):
    from slamlab.grading import batch, feedback

    marks = _marks(book, policy)
    batch.write_results(arguments.out, marks)
    for mark in marks:
        feedback.write_feedback_page(arguments.out, mark)
    return len(marks)
