"""``slamlab reset`` and ``slamlab update``: notebooks as handed out, and a new edition of them."""

import sys
from datetime import datetime
from pathlib import Path


def add_parser(subparsers):
    """Add the commands to the command line."""
    parser = subparsers.add_parser(
        "reset",
        help="give an exercise, a lesson or a task its handed-out form back",
        description=(
            "Give a notebook, or the cells of one task, the form back in which it was handed out. "
            "What stood there is kept beside it, with the date in its name."
        ),
    )
    parser.add_argument(
        "what",
        metavar="WHAT",
        help="an exercise (04), a lesson (lesson-04), a task (04-h-robot), or a notebook's path",
    )
    parser.set_defaults(run=run_reset)
    parser = subparsers.add_parser(
        "update",
        help="bring a new edition of the course into this folder",
        description=(
            "Bring the notebooks and programs of a new students' pack into this folder. Notebooks "
            "you did not touch are replaced; where you wrote, your cells stay and the text around "
            "them is new. The old file is kept beside it."
        ),
    )
    parser.add_argument("pack", metavar="ZIP", type=Path, help="the new slam-course.zip")
    parser.set_defaults(run=run_update)


def run_reset(arguments) -> int:
    """Reset; 2 where it cannot be done."""
    from slamlab.coursework.notebook_reset import ResetError, reset

    return _run("reset", ResetError, lambda place, now: reset(place, arguments.what, now))


def run_update(arguments) -> int:
    """Update; 2 where it cannot be done."""
    from slamlab.coursework.notebook_update import UpdateError, update

    return _run("update", UpdateError, lambda place, now: update(place, arguments.pack, now))


def _run(name, refused, act):
    from slamlab.coursework import folder

    place = folder.course_folder()
    try:
        if place is None:
            raise refused(folder.NO_COURSE)
        told = act(place, datetime.now())
    except refused as error:
        print(f"slamlab {name}: {error}", file=sys.stderr)
        return 2
    print(*told, sep="\n")
    return 0
