"""``slamlab handout LESSON``: a lesson's slides as a PDF."""

import sys
from pathlib import Path


def add_parser(subparsers):
    """Add the command to the command line."""
    parser = subparsers.add_parser(
        "handout",
        help="print a lesson's slides to a PDF",
        description=(
            "Print the slides of a lesson to a PDF, one a page, each as its last stop shows it, "
            "with what was drawn on it in the lecture (NAME.ink.json beside the notebook). "
            "Nothing is run: outputs are those that the file holds."
        ),
    )
    parser.add_argument("lesson", metavar="LESSON", help="a lesson (07) or a notebook's path")
    parser.add_argument("--notes", action="store_true", help="with notes below, two slides a page")
    parser.add_argument("--out", type=Path, metavar="PDF", help="where to (NAME.pdf, here)")
    parser.set_defaults(run=run)


def run(arguments) -> int:
    """Print; 1 where some ink is missing, 2 where it cannot be done."""
    from slamlab.lecturing.handout import write_handout
    from slamlab.lecturing.headless import Unavailable
    from slamlab.lecturing.shown_lesson import ShowError, lesson

    try:
        notebook = lesson(arguments.lesson)
        out = arguments.out or Path(notebook.stem + ".pdf")
        count, missing = write_handout(notebook, out, arguments.notes)
    except (ShowError, Unavailable, OSError) as error:
        print(f"slamlab handout: {error}", file=sys.stderr)
        return 2
    print(f"{out}: {count} slides")
    for what in missing:
        print(f"slamlab handout: {what}", file=sys.stderr)
    return int(bool(missing))
