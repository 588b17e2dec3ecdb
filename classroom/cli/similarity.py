"""``slamlab grade similarity``: list pairs of submissions that share rare code."""

from classroom.cli.common import EXERCISES, add_course_options, exercise_of, term_of
from slamlab.cli.common import printable, refuse
from slamlab.cli.parsers import UsageError, add_command

MAX_PAIRS = 10  # pairs of an exercise


def add_parser(subparsers):
    parser = add_command(
        subparsers,
        "grade similarity",
        "List pairs of submissions that share unusual code.",
        "04",
        "04 05 --out graded",
    )
    parser.add_argument("exercises", metavar="ID", nargs="*", help=EXERCISES)
    add_course_options(parser, policy=False)
    parser.set_defaults(run=run, policy=None)


def run(arguments) -> int:
    """List the pairs and return 0, or 2 for wrong usage."""
    from classroom.grading.gradebook import Gradebook, GradebookError, default_url
    from classroom.grading.term.course_file import TermError

    try:
        term = term_of(arguments)
        asked = [exercise_of(term, id) for id in arguments.exercises]
        url = arguments.db or default_url(arguments.out, new=False)
        with Gradebook(url, arguments.who) as book:
            records = _records(book, term)
            for id in asked or sorted(records):
                print("\n".join(map(printable, _lines(book, id, records.get(id, {})))))
    except (UsageError, TermError, GradebookError, KeyError) as error:
        return refuse("grade similarity", error)
    return 0


def _records(book, term):
    if term is not None:
        return {
            id: {s.student.id: s.mark.record for s in of_one if s.mark}
            for id, of_one in term.exercise_results(book).items()
        }
    found = {}
    for record in book.latest_attempts():
        if record.exercise:
            found.setdefault(record.exercise, {})[record.student] = record
    return found


def _lines(book, id, records):
    from classroom.grading.similarity.similarity_report import compare_submissions

    if not records:
        yield f"{id}: no submissions"
        return
    found = compare_submissions(book, records)
    pairs = found.comparison.pairs[:MAX_PAIRS]
    verdict = "" if pairs else "; no two of them share rare code"
    yield f"{id}: {found.comparison.count} submissions compared{verdict}"
    for pair in pairs:
        yield f"  {100 * pair.share:3.0f} %  {pair.left} – {pair.right}"
    for student, why in found.not_compared.items():
        yield f"  not compared: {student}: {why}"
    if not found.originals_excluded:
        yield "  The course's notebooks were not found, so the lessons' code is not excluded."
