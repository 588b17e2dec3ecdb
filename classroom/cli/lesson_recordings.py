"""``slamlab data get --lesson N``: an option of the library's command for the course's lessons."""

import argparse
import json

from classroom import installed_course


def add_parser(subparsers):
    help = "Fetch the recordings of a lesson of the course"
    parser = subparsers.choices["data get"]
    parser.add_argument("--lesson", metavar="N", dest="also", type=recordings_of, help=help)


def recordings_of(lesson):
    """Return the names of the recordings that a lesson uses. Raises ArgumentTypeError if none."""
    by_lesson = json.loads(installed_course.file("recordings.json").read_text("utf-8"))
    if (number := lesson.lstrip("0")) not in by_lesson:
        known = ", ".join(by_lesson)
        raise argparse.ArgumentTypeError(f"only lessons {known} use recordings, not {lesson!r}")
    return by_lesson[number]
