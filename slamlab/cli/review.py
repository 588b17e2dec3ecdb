"""``slamlab grade review``: a class's marks in a page of this machine, changed by hand."""

import asyncio
import sys
from pathlib import Path

from slamlab.cli.common import (
    COURSE,
    UsageError,
    add_page_options,
    add_who_option,
    check_port,
    open_page,
    term_of,
)
from slamlab.cli.grade_output import printable


def add_parser(subparsers):
    """Add the command to the command line; it is a word behind ``grade``."""
    parser = subparsers.add_parser(
        "grade review",
        description=(
            "Look at a class's submissions beside their verdicts in a page of the browser, which "
            "only this machine can open; points, comments and answers by hand become rows of the "
            "gradebook's ledger. Ctrl-C ends it and writes the tables anew."
        ),
    )
    parser.add_argument("--course", metavar="FILE", type=Path, help=COURSE)
    parser.add_argument(
        "--requests",
        metavar="PLACE",
        type=Path,
        help="requests for another look: a CSV with the columns student, exercise, request, or a "
        "folder or zip of notebooks with a text cell that begins with the heading 'Request for "
        "another look'; nothing in them is run, and they are no attempts",
    )
    add_page_options(parser)
    add_who_option(parser)
    parser.set_defaults(run=run, out=None, db=None, policy=None)


def run(arguments) -> int:
    """Serve until Ctrl-C; 0 then, 2 for wrong use."""
    from slamlab.grading.gradebook import Gradebook, GradebookError, default_url
    from slamlab.grading.term import course_file

    try:
        if not (arguments.course or Path(course_file.NAME)).exists():
            raise UsageError("a review needs a course file: slamlab grade init")
        check_port(arguments)
        term = term_of(arguments)
        url = arguments.db or default_url(arguments.out, new=False)
        with Gradebook(url, arguments.who) as book:
            _review(arguments, term, book)
    except (UsageError, course_file.TermError, GradebookError, KeyError) as error:
        print(f"slamlab grade review: {printable(str(error.args[0]))}", file=sys.stderr)
        return 2
    except OSError as error:
        said = " ".join(filter(None, (error.filename and f"{error.filename}:", error.strerror)))
        print(f"slamlab grade review: {said}", file=sys.stderr)
        return 2
    return 0


def _review(arguments, term, book):
    from slamlab.reviewing.class_state import ClassState
    from slamlab.reviewing.review_routes import serve
    from slamlab.reviewing.taking_requests import take_requests

    state = ClassState(term, book)
    if arguments.requests:
        print("\n".join(map(printable, take_requests(state, arguments.requests))))

    def begun(address):
        print(f"open {address}")
        print(f"changes stand as made by {printable(book.who)}; Ctrl-C ends", flush=True)
        if not arguments.no_open:
            open_page(address)

    changed = asyncio.run(serve(state, arguments.port, begun))
    if changed:
        term.write(book, changed)
        again = [id for id in sorted(changed) if (term.course.results / id / "release").is_dir()]
        print("tables and pages are written anew")
        for id in again:
            print(f"released already: slamlab grade release {id}")
