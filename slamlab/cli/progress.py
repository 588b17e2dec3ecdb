"""``slamlab progress``: how far one is in the course."""

import sys


def add_parser(subparsers):
    """Add the command to the command line."""
    parser = subparsers.add_parser(
        "progress",
        help="how far you are in the course",
        description=(
            "Show lessons, tasks and points, as check(), ask() and validate() kept them in "
            "progress.json in the course's folder. Nothing leaves this machine."
        ),
    )
    parser.set_defaults(run=run)


def run(arguments) -> int:
    """Print the overview; 2 where this is no folder of the course."""
    from slamlab.coursework import folder, overview, progress_file

    place = folder.course_folder()
    if place is None:
        print(f"slamlab progress: {folder.NO_COURSE}", file=sys.stderr)
        return 2
    print(overview.overview(place, progress_file.read(place)))
    return 0
