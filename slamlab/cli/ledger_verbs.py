"""``slamlab grade rejudge``, ``verify``, ``forget``: what the ledger of a gradebook allows."""

import re
import sys
from pathlib import Path

from slamlab.cli.common import UsageError, add_course_options, exercise_of, term_of
from slamlab.cli.grade_output import printable

VERBS = ("rejudge", "verify", "forget")
MOST_LINES = 60  # of a list that is shown; all of it stands in a file


def add_parser(subparsers):
    """Add the commands to the command line; they are words behind ``grade``."""
    rejudge = _parser(
        subparsers,
        "rejudge",
        "Judge all stored attempts by the tasks and laws that are installed now, and tell who "
        "gains and who loses. Nothing is written without --accept.",
    )
    rejudge.add_argument("exercises", metavar="ID", nargs="*", help="such as 04; default: all")
    rejudge.add_argument("--accept", action="store_true", help="write the new verdicts")
    _add_level(rejudge)
    verify = _parser(
        subparsers, "verify", "Prove that no row was altered, and every score from what is kept."
    )
    verify.add_argument(
        "--head",
        metavar="HASH",
        action="append",
        default=[],
        help="a head that a release told; it must still be in the ledger",
    )
    verify.add_argument(
        "--run", action="store_true", help="run the code of attempts whose outputs are not kept"
    )
    verify.add_argument("--secret", metavar="FILE", type=Path, help="default: DIR/secret")
    _add_level(verify)
    forget = _parser(
        subparsers, "forget", "Delete a student's name and content for good; hashes stay."
    )
    forget.add_argument("student", metavar="STUDENT", help="the id, or the name as in grades.csv")


def _parser(subparsers, verb, says):
    parser = subparsers.add_parser(f"grade {verb}", description=says)
    add_course_options(parser, policy=False)
    parser.set_defaults(run=run, verb=verb, policy=None)
    return parser


def _add_level(parser):
    parser.add_argument(
        "--isolation",
        choices=("strict", "basic", "none"),
        help="sandbox of code that has to be run again",
    )


def run(arguments) -> int:
    """Rejudge, verify or forget; 0 when done, 1 when something was altered, 2 for wrong use."""
    from slamlab.grading.gradebook import Gradebook, GradebookError, default_url
    from slamlab.grading.isolation import IsolationError
    from slamlab.grading.submissions import SubmissionError
    from slamlab.grading.term.course_file import TermError

    told = (UsageError, GradebookError, IsolationError, SubmissionError, TermError)
    verb = {"rejudge": _rejudge, "verify": _verify, "forget": _forget}[arguments.verb]
    try:
        term = term_of(arguments)
        url = arguments.db or default_url(arguments.out, new=False)
        with Gradebook(url, arguments.who) as book:
            return verb(arguments, book, term)
    except (*told, KeyError) as error:
        print(f"slamlab grade {arguments.verb}: {error.args[0]}", file=sys.stderr)
        return 2
    except OSError as error:
        said = f"{error.filename}: {error.strerror}"
        print(f"slamlab grade {arguments.verb}: {said}", file=sys.stderr)
        return 2


def _rejudge(arguments, book, term):
    from slamlab.grading import rejudge_report, rejudging

    ids = {exercise_of(term, id) for id in arguments.exercises} or None
    with rejudging.LazyWorkers(_level(arguments, term)) as workers:
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
    print(f"{len(judged) - len(lost)} attempts judged again, of {ran} the code was run: "
          f"{gain} gain, {lose} lose points; {len(lost)} could not be")  # fmt: skip
    new = [one.after for one in judged if one.after is not one.before]
    if new and not arguments.accept:
        print("nothing is written yet: --accept writes it")
    elif new:
        book.add_all(new, why="rejudged")
        write_tables(arguments.out, book, term)
        print("written; release what is released again")
    return 0


def _verify(arguments, book, term):
    from slamlab.grading import judge, rejudging
    from slamlab.grading.ledger import chain_merging, chain_proof, score_proof

    secret = arguments.secret or (term and term.course.secret) or arguments.out / "secret"
    known = judge.load_secret(secret) if arguments.secret or secret.exists() else None
    for head in arguments.head:
        if not re.fullmatch("[0-9a-f]{64}", head):
            raise UsageError(f"{head!r} is no head: a release tells one, of 64 letters and digits")
    rows = book.rows()
    wrong = chain_proof.altered(rows, arguments.head)
    with rejudging.LazyWorkers(_level(arguments, term)) as workers:
        start = workers.start if arguments.run else None
        proofs = list(score_proof.prove_all(book, known, start))
    wrong += [f"{p.record.submission} ({p.record.exercise}): {p.wrong}" for p in proofs if p.wrong]
    _list([f"wrong: {line}" for line in wrong])
    for kind, name in (("lacks", "needs the version"), ("unproved", "not proved")):
        count = {}
        for proof in proofs:
            said = getattr(proof, kind)
            count[said] = count.get(said, 0) + 1
        _list([f"{name}: {n} × {said}" for said, n in count.items() if said])
    for chain, (last, head) in chain_merging.heads(rows).items():
        print(f"ledger {chain}: rows 0 to {last}, head {head}")
    proved = sum(proof.proved for proof in proofs)
    print(f"{proved} of {len(proofs)} scores proved" + ("" if known else "; no secret was at hand"))
    return 1 if wrong else 0


def _forget(arguments, book, term):
    from slamlab.grading.term import releases

    gone = book.forget(arguments.student)
    if not gone:
        meant = term and term.roster.find(name=arguments.student)
        rest = f"did you mean the id {meant.id!r}?" if meant else "see grades.csv"
        raise UsageError(f"no attempt of {arguments.student!r} in the gradebook; {rest}")
    names = {record.stem for record in gone} | {releases.file_name(arguments.student)}
    for folder in (arguments.out, *arguments.out.glob("*/"), *arguments.out.glob("*/release/")):
        for page in folder.glob("feedback/*"):
            if page.stem in names:
                page.unlink()
    (arguments.out / "rejudged.csv").unlink(missing_ok=True)
    if term:
        term.forget(arguments.student)
    write_tables(arguments.out, book, term)
    print(f"{len(gone)} attempts forgotten: content and name are deleted, hashes stay")
    for id in sorted({record.exercise for record in gone} - {None}) if term else ():
        if (arguments.out / id / "release").is_dir():
            print(f"the last release of {id} still names the student: slamlab grade release {id}")
    if term and arguments.student in term.roster.students:
        print(f"{term.course.roster.name} still names the student: take the line out")
    print("the downloads that were graded, and copies of this gradebook, are yours to delete")
    return 0


def write_tables(out, book, term):
    """Write tables and pages anew, as the gradebook has it now."""
    from slamlab.grading import feedback, storing
    from slamlab.grading.marks import mark

    if term is not None:
        term.write(book)
        return
    overrides = book.overrides()
    marks = [mark(record, overrides) for record in book.latest_attempts()]
    storing.write_results(out, marks)
    for each in marks:
        feedback.write_feedback_page(out, each)


def _level(arguments, term):
    return arguments.isolation or (term.course.isolation if term else "strict")


def _list(lines, file=None):
    for line in lines[:MOST_LINES]:
        print(printable(line))
    if lines[MOST_LINES:]:
        print(f"… and {len(lines) - MOST_LINES} more" + (f": {file}" if file else ""))
