"""``slamlab progress``: show a student's lessons, tasks and points."""

from slamlab.cli.common import refuse
from slamlab.cli.parsers import add_command


def add_parser(subparsers):
    description = "Show your lessons, tasks and points in the course."
    parser = add_command(subparsers, "progress", description, "", "| less")
    parser.set_defaults(run=run)


def run(arguments) -> int:
    """Return 0, or 2 if this folder is not the course's folder."""
    from classroom.coursework import folder, progress_file, progress_overview

    root = folder.course_folder()
    if root is None:
        return refuse("progress", folder.NO_COURSE)
    print(progress_overview.overview(root, progress_file.read(root)))
    return 0
