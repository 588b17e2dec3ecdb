"""``slamlab handout LESSON``: print a lesson's slides to a PDF."""

import sys
from pathlib import Path

from slamlab.cli.common import refuse
from slamlab.cli.parsers import add_command


def add_parser(subparsers):
    parser = add_command(
        subparsers,
        "handout",
        "Print a lesson's slides to a PDF.",
        "07",
        "07 --notes --out notes.pdf",
    )
    parser.add_argument("lesson", metavar="LESSON", help="Lesson (07) or path to a notebook")
    parser.add_argument(
        "--notes", action="store_true", help="Print two slides per page, with notes"
    )
    out = "File to write (default: NAME.pdf in this folder)"
    parser.add_argument("--out", type=Path, metavar="PDF", help=out)
    parser.set_defaults(run=run)


def run(arguments) -> int:
    """Print the slides; return 0, or 1 if some ink is missing, or 2 if nothing can be printed."""
    from classroom.lecturing.handout import write_handout
    from classroom.lecturing.headless import Unavailable
    from classroom.lecturing.lesson_page import LessonError, find_lesson

    try:
        notebook = find_lesson(arguments.lesson)
        out = arguments.out or Path(notebook.stem + ".pdf")
        (slides, pages), missing = write_handout(notebook, out, arguments.notes)
    except (LessonError, Unavailable, OSError) as error:
        return refuse("handout", error)
    more = f"; full slides continue, so there are {pages} pages of slides"
    print(f"{out}: {slides} slides{more * (pages > slides)}")
    for what in missing:
        print(f"slamlab handout: {what}", file=sys.stderr)
    return int(bool(missing))
