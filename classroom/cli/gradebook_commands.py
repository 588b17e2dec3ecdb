"""``slamlab grade merge``, ``adjust``, ``export``: merge gradebooks, override points, export."""

import shutil
from dataclasses import replace
from pathlib import Path

from classroom.cli.common import add_course_options, answered, term_of
from slamlab.cli.parsers import UsageError, add_command


def add_parser(subparsers):
    description = "Merge the gradebooks of several runs into one."
    examples = "part1 part2 --out all", "sqlite:///copy.db --out all"
    merge = _parser(subparsers, "merge", description, *examples)
    merge.add_argument("books", metavar="BOOK", nargs="+", help="Database URL or folder of results")
    description = "Override the points of a task by hand."
    examples = "s123 04-h-robot 2.5 --reason 'wrong sign'", "s123 04-h-robot 0 --reason agreed"
    adjust = _parser(subparsers, "adjust", description, *examples)
    submission = "Submission as in grades.csv, or a student's id if there is a course file"
    adjust.add_argument("submission", metavar="SUBMISSION", help=submission)
    adjust.add_argument("task", metavar="TASK", help="Task, such as 04-h-robot")
    points = "Points of the task, which replace the judge's points; auto: the judge's points again"
    adjust.add_argument("points", metavar="POINTS", type=_points, help=points)
    reason = "Reason, which the student can read"
    adjust.add_argument("--reason", metavar="TEXT", required=True, help=reason)
    description = "Write the marks into nbgrader's gradebook."
    option = "--nbgrader-gradebook sqlite:///gradebook.db"
    export = _parser(subparsers, "export", description, option, f"{option} --out graded")
    url = "Database of nbgrader, such as sqlite:///gradebook.db"
    export.add_argument("--nbgrader-gradebook", metavar="URL", required=True, help=url)


def _points(text):
    return None if text == "auto" else float(text)


def _parser(subparsers, verb, description, *examples):
    parser = add_command(subparsers, f"grade {verb}", description, *examples)
    add_course_options(parser)
    parser.set_defaults(run=run, verb=verb)
    return parser


def run(arguments) -> int:
    """Run the command and return 0, or 2 for wrong usage."""
    from classroom.grading import late_policy
    from classroom.grading.gradebook import Gradebook, GradebookError, default_url
    from classroom.grading.nbgrader_gradebook import NbgraderError
    from classroom.grading.term.course_file import TermError

    refusals = (UsageError, GradebookError, NbgraderError, late_policy.LatePolicyError, TermError)
    verb = {"merge": _merge, "adjust": _adjust, "export": _export}[arguments.verb]

    def act():
        term = term_of(arguments)
        policy = late_policy.load(arguments.policy) if arguments.policy else None
        new = arguments.verb == "merge" and not arguments.out.exists()
        if new:
            arguments.out.mkdir(parents=True)
        try:
            url = arguments.db or default_url(arguments.out, arguments.verb == "merge")
            with Gradebook(url, arguments.who) as book:
                print(verb(arguments, book, term, policy))
        except refusals:
            if new:  # a failed merge leaves nothing
                shutil.rmtree(arguments.out)
            raise
        return 0

    return answered(f"grade {arguments.verb}", (*refusals, KeyError), act)


def _merge(arguments, book, term, policy):
    from classroom.grading.gradebook import Gradebook, default_url

    secrets = _secrets(arguments, term)
    before = len(book.rows())
    for name in arguments.books:
        with Gradebook(name if "://" in name else default_url(Path(name), new=False)) as other:
            _check_seeds(name, other, secrets)
            book.merge(other)
    count, new = _write(arguments, book, term, policy), len(book.rows()) - before
    table = arguments.out / "grades.csv"
    return f"rows added to the ledger: {new}; submissions in total: {count}; {table}"


def _secrets(arguments, term):
    """Return the first secret that exists: of the result, of the term, or of a merged folder."""
    from classroom.grading import judge

    mine = [arguments.out / "secret", *([term.course.secret] if term else [])]
    mine += [Path(name) / "secret" for name in arguments.books if "://" not in name]
    return [judge.load_secret(file) for file in mine if file.is_file()][:1]


def _check_seeds(name, other, secrets):
    """Refuse a gradebook that was graded with another secret."""
    from classroom.grading.gradebook import GradebookError
    from classroom.grading.judge import seed_for

    for record in other.attempts().values() if secrets else ():
        if record.seed not in (None, seed_for(secrets[0], record.exercise, record.sha256).hex()):
            raise GradebookError(
                f"{name} was graded with another secret, so its scores cannot be verified here. "
                "Copy the file secret before grading, and grade its submissions again"
            )


def _adjust(arguments, book, term, policy):
    from classroom.exercises import catalogue
    from classroom.grading.marks import mark

    task = catalogue.task(arguments.task)
    points, id = arguments.points, arguments.task[:2]
    record = _record(arguments.submission, id, book, term)
    if not arguments.reason.strip():
        raise KeyError("--reason is empty. Write a reason, which the student can read")
    if points is not None and not 0 <= points <= task.points:
        raise KeyError(f"{arguments.task} must have 0 to {task.points:g} points, not {points:g}")
    book.override_points(record, arguments.task, points, arguments.reason)
    _write(arguments, book, term, policy, exercises={id})
    value = "the autograder's points" if points is None else f"{points:g}"
    after = mark(replace(record, exercise=id), book.overrides()).without_points
    return f"{record.submission}: {arguments.task} set to {value}" + (after and f". {after}")


def _record(name, exercise, book, term):
    """Return the newest attempt of a submission with this name or, in a term, the attempt that
    counts of the student with this id. Raises KeyError.
    """
    if term is not None and name in term.roster.students:
        results = term.exercise_results(book).get(exercise, [])
        counted = [s.mark.record for s in results if s.student.id == name and s.mark]
        if not counted:
            raise KeyError(f"{name} has no submission for {exercise}")
        return counted[0]
    made = [record for record in book.latest_attempts() if record.submission == name]
    if not made:
        who = "Give the student's id" if term else "grades.csv lists them"
        raise KeyError(f"the gradebook has no submission {name!r}. {who}")
    mine = [record for record in made if record.exercise in (None, exercise)]
    if not mine:
        listed = " and ".join(sorted(record.exercise for record in made))
        raise KeyError(f"{name} is for exercise {listed}, but the task is not")
    return mine[-1]


def _export(arguments, book, term, policy):
    from classroom.grading import nbgrader_gradebook

    if term is None:
        marks = _marks(book, policy)
    else:
        term.write(book, ())
        marks = [
            s.mark for of_one in term.exercise_results(book).values() for s in of_one if s.mark
        ]
    count = nbgrader_gradebook.export(marks, arguments.nbgrader_gradebook)
    return f"{count} submissions written to {arguments.nbgrader_gradebook}"


def _marks(book, policy):
    from classroom.grading.marks import mark

    if policy is not None:
        for record in book.latest_attempts():
            book.add(replace(record, policy=policy.stored(record.student)))
    overrides = book.overrides()
    return [mark(record, overrides) for record in book.latest_attempts()]


def _write(arguments, book, term, policy, exercises=None):
    from classroom.grading import feedback, result_storage

    if term is not None:
        return len(term.write(book, exercises))
    marks = _marks(book, policy)
    result_storage.write_results(arguments.out, marks)
    for mark in marks:
        feedback.write_feedback_page(arguments.out, mark)
    return len(marks)
