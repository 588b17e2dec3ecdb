"""``slamlab grade review``: review and change a class's marks in the browser."""

import asyncio
from pathlib import Path

from classroom.cli.common import COURSE, add_who_option, term_of
from slamlab.cli.common import add_page_options, check_port, open_page, printable, refuse
from slamlab.cli.parsers import UsageError, add_command


def add_parser(subparsers):
    parser = add_command(
        subparsers,
        "grade review",
        "Review and change a class's marks in the browser.",
        "--no-open",
        "--requests requests.csv",
    )
    parser.add_argument("--course", metavar="FILE", type=Path, help=COURSE)
    requests = (
        "Regrade requests: a CSV file (student, exercise, request), or a folder or zip of notebooks"
    )
    parser.add_argument("--requests", metavar="FILE", type=Path, help=requests)
    add_page_options(parser)
    add_who_option(parser)
    parser.set_defaults(run=run, out=None, db=None, policy=None)


def run(arguments) -> int:
    """Serve the page until Ctrl-C, then return 0; return 2 for wrong usage."""
    from classroom.grading.gradebook import Gradebook, GradebookError, default_url
    from classroom.grading.term import course_file

    try:
        if not (arguments.course or Path(course_file.NAME)).exists():
            raise UsageError("a review needs a course file. Write one with slamlab grade init")
        check_port(arguments)
        term = term_of(arguments)
        url = arguments.db or default_url(arguments.out, new=False)
        with Gradebook(url, arguments.who) as book:
            _review(arguments, term, book)
    except (UsageError, course_file.TermError, GradebookError, KeyError, OSError) as error:
        return refuse("grade review", error)
    return 0


def _review(arguments, term, book):
    from classroom.reviewing.class_state import ClassState
    from classroom.reviewing.regrade_requests import take_regrade_requests
    from classroom.reviewing.review_routes import serve

    state = ClassState(term, book)
    if arguments.requests:
        print("\n".join(map(printable, take_regrade_requests(state, arguments.requests))))

    def started(address):
        print(f"open {address}")
        print(f"Changes are recorded as made by {printable(book.who)}.")
        print("Press Ctrl-C to end the review and write the tables.", flush=True)
        if not arguments.no_open:
            open_page(address)

    changed = asyncio.run(serve(state, arguments.port, started))
    term.write(book, changed)
    print("The tables and the feedback pages are updated.")
    for id in sorted(changed):
        if (term.course.results / id / "release").is_dir():
            print(
                f"Exercise {id} was released before. Release it again: slamlab grade release {id}"
            )
