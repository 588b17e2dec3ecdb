"""``slamlab reset`` and ``update``: restore original notebooks, and install a new edition."""

from datetime import datetime
from pathlib import Path

from slamlab.cli.common import refuse
from slamlab.cli.parsers import add_command


def add_parser(subparsers):
    parser = add_command(
        subparsers,
        "reset",
        "Restore an exercise, a lesson or a task to its original form.",
        "04",
        "04-h-robot",
    )
    what = "Exercise (04), lesson (lesson-04), task (04-h-robot) or notebook"
    parser.add_argument("what", metavar="WHAT", help=what)
    parser.set_defaults(run=run_reset)
    parser = add_command(
        subparsers,
        "update",
        "Update the course in this folder to a new edition.",
        "slam-course.zip",
        "~/Downloads/slam-course.zip",
    )
    pack = "New edition of the course, slam-course.zip"
    parser.add_argument("pack", metavar="ZIP", type=Path, help=pack)
    parser.set_defaults(run=run_update)


def run_reset(arguments) -> int:
    from classroom.coursework.notebook_reset import ResetError, reset

    return _run("reset", ResetError, lambda root, now: reset(root, arguments.what, now))


def run_update(arguments) -> int:
    from classroom.coursework.notebook_update import UpdateError, update

    return _run("update", UpdateError, lambda root, now: update(root, arguments.pack, now))


def _run(name, refused, act):
    from classroom.coursework import folder

    root = folder.course_folder()
    try:
        if root is None:
            raise refused(folder.NO_COURSE)
        lines = act(root, datetime.now())
    except refused as error:
        return refuse(name, error)
    print(*lines, sep="\n")
    return 0
