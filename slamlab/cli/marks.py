"""``slamlab grade merge``, ``adjust`` and ``export``: what is done with gradebooks afterwards."""

import sys
from pathlib import Path

VERBS = ("merge", "adjust", "export")


def add_parser(subparsers):
    """Add the commands to the command line; they are words behind ``grade``."""
    merge = _parser(subparsers, "merge", "Put the gradebooks of several runs into one.")
    merge.add_argument("books", metavar="BOOK", nargs="+", help="URL, or folder of results")
    adjust = _parser(subparsers, "adjust", "Set the points of a task by hand; the judge's stay.")
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
    parser.add_argument("--policy", metavar="FILE", type=Path, help="what lateness costs")
    parser.set_defaults(run=run, verb=verb)
    return parser


def run(arguments) -> int:
    """Do it; 0 when done, 2 for wrong use."""
    from slamlab.grading import late
    from slamlab.grading.gradebook import Gradebook, NoGradebook, url_of
    from slamlab.grading.nbgrader import NoNbgrader

    verb = {"merge": _merge, "adjust": _adjust, "export": _export}[arguments.verb]
    try:
        policy = late.load(arguments.policy) if arguments.policy else late.NONE
        if arguments.verb == "merge":
            arguments.out.mkdir(parents=True, exist_ok=True)
        with Gradebook(arguments.db or url_of(arguments.out, arguments.verb == "merge")) as book:
            print(verb(arguments, book, policy))
    except (NoGradebook, NoNbgrader, late.WrongPolicy, KeyError) as error:
        print(f"slamlab grade {arguments.verb}: {error.args[0]}", file=sys.stderr)
        return 2
    except OSError as error:
        print(
            f"slamlab grade {arguments.verb}: {error.filename}: {error.strerror}", file=sys.stderr
        )
        return 2
    return 0


def _merge(arguments, book, policy):
    from slamlab.grading.gradebook import Gradebook, url_of

    added = 0
    for name in arguments.books:
        with Gradebook(name if "://" in name else url_of(Path(name), new=False)) as other:
            added += book.take(other)
    count = _write(arguments, book, policy)
    return f"{added} attempts added; {count} submissions: {arguments.out / 'grades.csv'}"


def _adjust(arguments, book, policy):
    from slamlab.checks import catalogue

    task = catalogue.task(arguments.task)
    known = {record.submission: record for record in book.latest()}
    if arguments.submission not in known:
        raise KeyError(f"no submission {arguments.submission!r} in the gradebook; see grades.csv")
    exercise = known[arguments.submission].exercise
    if exercise not in (None, arguments.task[:2]):
        raise KeyError(f"{arguments.submission} is of exercise {exercise}, {arguments.task} is not")
    if not 0 <= arguments.points <= task.points:
        raise KeyError(
            f"{arguments.task} has 0 to {task.points:g} points, not {arguments.points:g}"
        )
    book.adjust(
        arguments.submission, arguments.task[:2], arguments.task, arguments.points, arguments.reason
    )
    _write(arguments, book, policy)
    return f"{arguments.submission}: {arguments.task} set to {arguments.points:g}"


def _export(arguments, book, policy):
    from slamlab.grading import nbgrader

    count = nbgrader.export(_marks(book, policy), arguments.nbgrader_gradebook)
    return f"{count} submissions written to {arguments.nbgrader_gradebook}"


def _marks(book, policy):
    from slamlab.grading.marks import mark

    by_hand = book.adjustments()
    return [mark(record, by_hand, policy) for record in book.latest()]


def _write(arguments, book, policy):
    from slamlab.grading import feedback, folder

    marks = _marks(book, policy)
    folder.write_results(arguments.out, marks)
    for mark in marks:
        feedback.write_page(arguments.out, mark)
    return len(marks)
