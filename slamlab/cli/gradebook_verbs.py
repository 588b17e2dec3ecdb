"""``slamlab grade merge``, ``adjust``, ``export``: merge gradebooks, override points, export."""

import sys
from argparse import ArgumentTypeError
from dataclasses import replace
from pathlib import Path

from slamlab.cli.common import UsageError, add_course_options, term_of

VERBS = ("merge", "adjust", "export")


def add_parser(subparsers):
    """Add the commands to the command line; they are words behind ``grade``."""
    merge = _parser(subparsers, "merge", "Put the gradebooks of several runs into one.")
    merge.add_argument("books", metavar="BOOK", nargs="+", help="URL, or folder of results")
    adjust = _parser(
        subparsers, "adjust", "Override the points of a task by hand; the judge's stay."
    )
    adjust.add_argument(
        "submission", metavar="SUBMISSION", help="as in grades.csv; in a term a student's id"
    )
    adjust.add_argument("task", metavar="TASK", help="such as 04-h-robot")
    adjust.add_argument(
        "points", metavar="POINTS", type=number, help="of the task, in place of the judge's"
    )
    adjust.add_argument("--reason", metavar="TEXT", required=True, help="why; the student reads it")
    export = _parser(subparsers, "export", "Write marks where another program keeps them.")
    export.add_argument(
        "--nbgrader-gradebook",
        metavar="URL",
        required=True,
        help="nbgrader's database, such as sqlite:///gradebook.db",
    )


def number(text):
    """A number of points as it is typed."""
    try:
        return float(text)
    except ValueError:
        raise ArgumentTypeError(f"{text!r} is no number such as 1.5") from None


def _parser(subparsers, verb, says):
    parser = subparsers.add_parser(f"grade {verb}", description=says)
    add_course_options(parser)
    parser.set_defaults(run=run, verb=verb)
    return parser


def run(arguments) -> int:
    """Merge, override or export; 0 when done, 2 for wrong use."""
    from slamlab.grading import late_policy
    from slamlab.grading.gradebook import Gradebook, GradebookError, default_url
    from slamlab.grading.nbgrader_gradebook import NbgraderError
    from slamlab.grading.term.course_file import TermError

    told = (UsageError, GradebookError, NbgraderError, late_policy.LatePolicyError, TermError)
    verb = {"merge": _merge, "adjust": _adjust, "export": _export}[arguments.verb]
    try:
        term = term_of(arguments)
        policy = late_policy.load(arguments.policy) if arguments.policy else None
        if arguments.verb == "merge":
            arguments.out.mkdir(parents=True, exist_ok=True)
        url = arguments.db or default_url(arguments.out, arguments.verb == "merge")
        with Gradebook(url, arguments.who) as book:
            print(verb(arguments, book, term, policy))
    except (*told, KeyError) as error:
        print(f"slamlab grade {arguments.verb}: {error.args[0]}", file=sys.stderr)
        return 2
    except OSError as error:
        print(
            f"slamlab grade {arguments.verb}: {error.filename}: {error.strerror}", file=sys.stderr
        )
        return 2
    return 0


def _merge(arguments, book, term, policy):
    from slamlab.grading.gradebook import Gradebook, default_url

    added = 0
    for name in arguments.books:
        with Gradebook(name if "://" in name else default_url(Path(name), new=False)) as other:
            added += book.merge(other)
    count = _write(arguments, book, term, policy)
    return f"{added} attempts added; now {count} submissions: {arguments.out / 'grades.csv'}"


def _adjust(arguments, book, term, policy):
    from slamlab.exercises import catalogue

    task = catalogue.task(arguments.task)
    name = _submission(arguments, book, term)
    made = {r.exercise for r in book.attempts().values() if r.submission == name}
    if not made:
        who = "give the student's id" if term else "see grades.csv"
        raise KeyError(f"no submission {name!r} in the gradebook; {who}")
    if made.isdisjoint({None, arguments.task[:2]}):
        listed = " and ".join(sorted(made))
        raise KeyError(f"{name} is of exercise {listed}, {arguments.task} is not")
    if not arguments.reason.strip():
        raise KeyError("--reason is empty: the student reads it")
    if not 0 <= arguments.points <= task.points:
        raise KeyError(
            f"{arguments.task} has 0 to {task.points:g} points, not {arguments.points:g}"
        )
    book.override_points(
        name, arguments.task[:2], arguments.task, arguments.points, arguments.reason
    )
    _write(arguments, book, term, policy, exercises={arguments.task[:2]})
    return f"{name}: {arguments.task} set to {arguments.points:g}"


def _submission(arguments, book, term):
    """The submission that is meant: by its name, or in a term by the student's id."""
    if term is None or arguments.submission not in term.roster.students:
        return arguments.submission
    standings = term.standings(book).get(arguments.task[:2], [])
    counted = [s.mark for s in standings if s.student.id == arguments.submission and s.mark]
    if not counted:
        raise KeyError(f"{arguments.submission} has handed in nothing for {arguments.task[:2]}")
    return counted[0].record.submission


def _export(arguments, book, term, policy):
    from slamlab.grading import nbgrader_gradebook

    if term is None:
        marks = _marks(book, policy)
    else:
        marks = [s.mark for of_one in term.standings(book).values() for s in of_one if s.mark]
    count = nbgrader_gradebook.export(marks, arguments.nbgrader_gradebook)
    return f"{count} submissions written to {arguments.nbgrader_gradebook}"


def _marks(book, policy):
    from slamlab.grading.marks import mark

    if policy is not None:
        for record in book.latest_attempts():
            book.add(replace(record, policy=policy.stored(record.student)))
    overrides = book.overrides()
    return [mark(record, overrides) for record in book.latest_attempts()]


def _write(arguments, book, term, policy, exercises=None):
    from slamlab.grading import feedback, storing

    if term is not None:
        return len(term.write(book, exercises))
    marks = _marks(book, policy)
    storing.write_results(arguments.out, marks)
    for mark in marks:
        feedback.write_feedback_page(arguments.out, mark)
    return len(marks)
