"""``slamlab check NOTEBOOK``: validate an exercise notebook as grading does, without grading."""

import sys
from pathlib import Path


def add_parser(subparsers):
    """Add the command to the command line."""
    parser = subparsers.add_parser(
        "check",
        help="check an exercise notebook",
        description=(
            "Run a notebook's cells in order in a fresh process and all tasks of its exercise on "
            "the functions they define, as grading does, with the inputs that check() uses. Says "
            "what grading would trip over: cells that run only in another order, modules that are "
            "not there, too much time."
        ),
        epilog=(
            "Exit code: 0 when all tasks are passed, 1 when one is not, 2 when the notebook cannot "
            "be checked."
        ),
    )
    parser.add_argument("notebook", metavar="NOTEBOOK", type=Path)
    parser.add_argument(
        "--exercise", metavar="ID", help="where the notebook does not tell it, such as 04 or 4"
    )
    parser.set_defaults(run=run)


def run(arguments) -> int:
    """Check; 0 when all tasks are passed, 1 when one is not, 2 when it cannot be checked."""
    from slamlab.checks import validation
    from slamlab.exercises import catalogue

    try:
        if arguments.exercise is not None:
            catalogue.exercise(arguments.exercise)
        return 0 if validation.validate(arguments.notebook, arguments.exercise) else 1
    except (validation.ValidationError, KeyError) as error:
        print(f"slamlab check: {error.args[0]}", file=sys.stderr)
        return 2
