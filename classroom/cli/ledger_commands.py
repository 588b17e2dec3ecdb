"""``slamlab grade rejudge``, ``verify``, ``forget``: commands that use a gradebook's ledger."""

import re
from pathlib import Path

from classroom.cli.common import (
    EXERCISES,
    add_course_options,
    add_isolation_option,
    answered,
    exercise_of,
    term_of,
)
from slamlab.cli.common import FAILED, printable
from slamlab.cli.parsers import UsageError, add_command

MAX_LINES = 60  # of a list that is printed; a file contains all of them
MAX_NAMES = 10  # of submissions in a line


def add_parser(subparsers):
    description = "Judge stored attempts again with the installed tasks."
    rejudge = _parser(subparsers, "rejudge", description, "04", "--accept")
    rejudge.add_argument("exercises", metavar="ID", nargs="*", help=EXERCISES)
    accept = "Write the new verdicts (default: only list the changes)"
    rejudge.add_argument("--accept", action="store_true", help=accept)
    add_isolation_option(rejudge)
    description = "Verify the ledger of the gradebook and every score."
    verify = _parser(subparsers, "verify", description, "--run", "--head HASH")
    head = "Check that the ledger contains this head, which a release printed; repeatable"
    verify.add_argument("--head", metavar="HASH", action="append", default=[], help=head)
    run_help = "Run the code of attempts whose outputs are not stored"
    verify.add_argument("--run", action="store_true", help=run_help, dest="run_code")
    secret = "Secret, a seed of random inputs (default: DIR/secret)"
    verify.add_argument("--secret", metavar="FILE", type=Path, help=secret)
    add_isolation_option(verify)
    description = "Delete a student's name and content from the gradebook."
    forget = _parser(subparsers, "forget", description, "s123", "s123 --out graded")
    forget.add_argument("student", metavar="STUDENT", help="Id or name, as in grades.csv")


def _parser(subparsers, verb, description, *examples):
    parser = add_command(subparsers, f"grade {verb}", description, *examples)
    add_course_options(parser, policy=False)
    parser.set_defaults(run=run, verb=verb, policy=None)
    return parser


def run(arguments) -> int:
    """Return 0 for success, 1 if something was altered or not judged, 2 for wrong usage."""
    from classroom.grading.gradebook import Gradebook, GradebookError, default_url
    from classroom.grading.isolation import IsolationError
    from classroom.grading.submissions import SubmissionError
    from classroom.grading.term.course_file import TermError

    refusals = (UsageError, GradebookError, IsolationError, SubmissionError, TermError)
    verb = {"rejudge": _rejudge, "verify": _verify, "forget": _forget}[arguments.verb]

    def act():
        term = term_of(arguments)
        url = arguments.db or default_url(arguments.out, new=False)
        with Gradebook(url, arguments.who) as book:
            return verb(arguments, book, term)

    return answered(f"grade {arguments.verb}", (*refusals, KeyError), act)


def _rejudge(arguments, book, term):
    from classroom.grading import rejudge_report, rejudging

    ids = {exercise_of(term, id) for id in arguments.exercises} or None
    with rejudging.LazyWorkerPool(_level(arguments, term)) as workers:
        judged = list(rejudging.rejudge_all(book, workers, ids))
    found = rejudge_report.changes(judged, book.overrides(), term and term.policy)
    rejudge_report.write_changes(arguments.out, found)
    lines = [f"{id} {who} ({name}): {before} → {after}: {why}"
             for _, (id, who, name, before, after, why) in found]  # fmt: skip
    _list(lines, arguments.out / "rejudged.csv")
    lost = [f"{one.before.submission}: {one.problem}" for one in judged if one.problem]
    _list([f"not judged again: {line}" for line in lost])
    gain, lose = (sum(sign * by > 0 for by, _ in found) for sign in (1, -1))
    ran = sum(one.ran for one in judged)
    print(f"{len(judged) - len(lost)} attempts judged again, {ran} of them by running the code: "
          f"{gain} gain points, {lose} lose points, {len(lost)} could not be judged")  # fmt: skip
    new = [one.after for one in judged if one.after is not one.before]
    if new and not arguments.accept:
        print("Nothing was written. Add --accept to write the new verdicts.")
    elif new:
        book.add_all(new, why="rejudged")
        write_tables(arguments.out, book, term)
        print("The new verdicts are written. Release again each exercise that was released before.")
    return FAILED if lost else 0


def _verify(arguments, book, term):
    from classroom.grading import judge, rejudging
    from classroom.grading.ledger import chain_merging, chain_verification, score_verification

    secret = arguments.secret or (term and term.course.secret) or arguments.out / "secret"
    known = judge.load_secret(secret) if arguments.secret or secret.exists() else None
    for head in arguments.head:
        if not re.fullmatch("[0-9a-f]{64}", head):
            raise UsageError(
                f"{head!r} is not a ledger head. A release prints a head of 64 hexadecimal digits"
            )
    rows = book.rows()
    wrong = chain_verification.find_alterations(rows, arguments.head)
    with rejudging.LazyWorkerPool(_level(arguments, term)) as workers:
        start = workers.start if arguments.run_code else None
        scores = list(score_verification.verify_all(book, known, start))
    wrong += [f"{p.record.submission} ({p.record.exercise}): {p.wrong}" for p in scores if p.wrong]
    _list([f"wrong: {line}" for line in wrong])
    for kind, name in (("lacks", "needs the version"), ("unverified", "not verified")):
        of_reason = {}
        for score in scores:
            if reason := getattr(score, kind):
                record = score.record
                of_reason.setdefault(reason, []).append(f"{record.submission} ({record.exercise})")
        for reason, which in of_reason.items():
            more = f", … and {len(which) - MAX_NAMES} more" if which[MAX_NAMES:] else ""
            print(printable(f"{name}: {', '.join(which[:MAX_NAMES])}{more}: {reason}"))
    for chain, (last, head) in chain_merging.heads(rows).items():
        print(f"ledger {chain}: rows 0 to {last}, head {head}")
    verified = sum(score.verified for score in scores)
    missing = "" if known else "; the secret was not found"
    print(f"{verified} of {len(scores)} scores verified{missing}")
    return FAILED if wrong else 0


def _forget(arguments, book, term):
    from classroom.grading.term import releases

    gone = book.forget(arguments.student)
    if not gone:
        meant = term and term.roster.find(name=arguments.student)
        rest = f"Did you mean the id {meant.id!r}?" if meant else "grades.csv lists the students"
        raise UsageError(f"the gradebook has no attempt by {arguments.student!r}. {rest}")
    names = {record.stem for record in gone} | {releases.file_name(arguments.student)}
    for folder in (arguments.out, *arguments.out.glob("*/"), *arguments.out.glob("*/release/")):
        for page in folder.glob("feedback/*"):
            if page.stem in names:
                page.unlink()
    (arguments.out / "rejudged.csv").unlink(missing_ok=True)
    if term:
        term.forget(arguments.student)
    write_tables(arguments.out, book, term)
    print(f"Attempts whose name and content are deleted: {len(gone)}; their hashes remain.")
    for id in sorted({record.exercise for record in gone} - {None}) if term else ():
        if (arguments.out / id / "release").is_dir():
            print(f"The last release of {id} names the student: run slamlab grade release {id}")
    if term and arguments.student in term.roster.students:
        print(f"Delete the student's line in {term.course.roster.name}.")
    print("Also delete the downloaded submissions and any copies of this gradebook.")
    return 0


def write_tables(out, book, term):
    from classroom.grading import feedback, result_storage
    from classroom.grading.marks import mark

    if term is not None:
        term.write(book)
        return
    overrides = book.overrides()
    marks = [mark(record, overrides) for record in book.latest_attempts()]
    result_storage.write_results(out, marks)
    for each in marks:
        feedback.write_feedback_page(out, each)


def _level(arguments, term):
    return arguments.isolation or (term.course.isolation if term else "strict")


def _list(lines, file=None):
    for line in lines[:MAX_LINES]:
        print(printable(line))
    if lines[MAX_LINES:]:
        print(f"… and {len(lines) - MAX_LINES} more" + (f": {file}" if file else ""))
