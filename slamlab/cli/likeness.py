"""``slamlab grade likeness``: who shares with whom what is rare in the class."""

import sys

from slamlab.cli.common import UsageError, add_course_options, exercise_of, term_of
from slamlab.cli.grade_output import printable

MOST = 10  # pairs of an exercise


def add_parser(subparsers):
    """Add the command to the command line; it is a word behind ``grade``."""
    parser = subparsers.add_parser(
        "grade likeness",
        description=(
            "List the pairs of students who share most of what is rare in an exercise's class: "
            "names, comments and layout do not count, nor what was handed out or more than half "
            "have. A hint where to look; slamlab grade review shows two side by side."
        ),
    )
    parser.add_argument("exercises", metavar="ID", nargs="*", help="such as 04; default: all")
    add_course_options(parser, policy=False)
    parser.set_defaults(run=run, policy=None)


def run(arguments) -> int:
    """List the pairs; 0 when done, 2 for wrong use."""
    from slamlab.grading.gradebook import Gradebook, GradebookError, default_url
    from slamlab.grading.term.course_file import TermError

    try:
        term = term_of(arguments)
        asked = [exercise_of(term, id) for id in arguments.exercises]
        url = arguments.db or default_url(arguments.out, new=False)
        with Gradebook(url, arguments.who) as book:
            records = _records(book, term)
            for id in asked or sorted(records):
                print("\n".join(map(printable, _told(book, id, records.get(id, {})))))
    except (UsageError, TermError, GradebookError, KeyError) as error:
        print(f"slamlab grade likeness: {printable(str(error.args[0]))}", file=sys.stderr)
        return 2
    return 0


def _records(book, term):
    """Exercise to student to the record that counts."""
    if term is not None:
        return {
            id: {s.student.id: s.mark.record for s in of_one if s.mark}
            for id, of_one in term.standings(book).items()
        }
    found = {}
    for record in book.latest_attempts():
        if record.exercise:
            found.setdefault(record.exercise, {})[record.student] = record
    return found


def _told(book, id, records):
    from slamlab.grading.likeness.kept_submissions import likeness_of

    if not records:
        yield f"{id}: nobody has handed in anything"
        return
    found = likeness_of(book, records)
    yield f"{id}: {found.of_class.count} submissions compared"
    for pair in found.of_class.pairs[:MOST]:
        yield f"  {100 * pair.share:3.0f} %  {pair.left} – {pair.right}"
    for student, why in found.not_compared.items():
        yield f"  not compared: {student}: {why}"
    if not found.knows_handed_out:
        yield "  the notebooks handed out are not beside this program: a lesson's code counts, too"
