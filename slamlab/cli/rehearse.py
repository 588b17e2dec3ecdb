"""``slamlab rehearse LESSON``: run and step through a lesson as the lecture will."""

import argparse
import re
import sys


def add_parser(subparsers):
    """Add the command to the command line."""
    parser = subparsers.add_parser(
        "rehearse",
        help="run a lesson and step through its slides, as the lecture will",
        description=(
            "Run all cells of a copy of a lesson in a JupyterLab of its own, step through all its "
            "slides in a browser without a window, and tell by section how long the kernel takes, "
            "which minutes are planned, how small the letters get, what is slow, and what the "
            "cells need besides themselves (a device, a network, a recording), as their imports "
            "and calls show."
        ),
        epilog=(
            "Exit code: 0 when nothing is wrong; 1 when a cell fails, letters are smaller than "
            "75 %, a slide does not fit or the plan does not add up; 2 when it cannot be rehearsed."
        ),
    )
    parser.add_argument("lesson", metavar="LESSON", help="a lesson (07) or a notebook's path")
    parser.add_argument(
        "--screen", type=size, default="1280x720", help="the projector's size (1280x720)"
    )
    parser.add_argument(
        "--patience", type=float, default=30, help="minutes that all cells may take (30)"
    )
    parser.set_defaults(run=run)


def size(text):
    """The width and height that "1280x720" says; ArgumentTypeError where it says none."""
    match = re.fullmatch(r"([1-9]\d{2,3})x([1-9]\d{2,3})", text)
    if not match:
        raise argparse.ArgumentTypeError(f"{text!r} is no size such as 1280x720")
    return int(match[1]), int(match[2])


def run(arguments) -> int:
    """Rehearse; 0 when nothing is wrong, 1 when something is, 2 when it cannot be rehearsed."""
    from rich.console import Console

    from slamlab.lecturing.headless import Unavailable
    from slamlab.lecturing.rehearsal import rehearse
    from slamlab.lecturing.rehearsal_report import report
    from slamlab.lecturing.shown_lesson import ShowError, lesson

    try:
        notebook = lesson(arguments.lesson)
        print(f"rehearsing {notebook.name} …", file=sys.stderr)
        rehearsed = rehearse(notebook, arguments.screen, arguments.patience)
    except (ShowError, Unavailable) as error:
        print(f"slamlab rehearse: {error}", file=sys.stderr)
        return 2
    report(rehearsed, Console())
    return 0 if rehearsed.is_sound else 1
