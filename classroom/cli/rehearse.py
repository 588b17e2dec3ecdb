"""``slamlab rehearse LESSON``: run a lesson and step through its slides before the lecture."""

import argparse
import re
import sys
import time

from slamlab.cli.common import refuse
from slamlab.cli.parsers import add_command


def add_parser(subparsers):
    parser = add_command(
        subparsers,
        "rehearse",
        "Run a lesson and step through its slides, as in the lecture.",
        "07",
        "07 --screen 1920x1080 --patience 10",
    )
    parser.add_argument("lesson", metavar="LESSON", help="Lesson (07) or path to a notebook")
    screen = "Size of the projector's picture [pixels] (default: 1280x720)"
    parser.add_argument("--screen", metavar="WxH", type=size, default="1280x720", help=screen)
    patience = "Time limit for all cells together [min] (default: 30)"
    parser.add_argument("--patience", metavar="MIN", type=float, default=30, help=patience)
    parser.set_defaults(run=run)


def size(text):
    """Parse a size such as "1280x720" into width and height. Raises ArgumentTypeError."""
    match = re.fullmatch(r"([1-9]\d{2,3})x([1-9]\d{2,3})", text)
    if not match:
        raise argparse.ArgumentTypeError(f"{text!r} is not a size such as 1280x720")
    return int(match[1]), int(match[2])


def run(arguments) -> int:
    """Return 0 if the lesson has no faults, 1 if it has some, 2 if it cannot be rehearsed."""
    from rich.console import Console

    from classroom.lecturing.headless import Unavailable
    from classroom.lecturing.lesson_page import LessonError, find_lesson
    from classroom.lecturing.rehearsal import rehearse
    from classroom.lecturing.rehearsal_report import report

    try:
        notebook = find_lesson(arguments.lesson)
        print(f"rehearsing {notebook.name} …", file=sys.stderr)
        began = time.monotonic()
        rehearsed = rehearse(notebook, arguments.screen, arguments.patience)
    except (LessonError, Unavailable) as error:
        return refuse("rehearse", error)
    report(rehearsed, Console())
    print(f"The rehearsal took {time.monotonic() - began:.0f} s.")
    return 0 if rehearsed.is_sound else 1
