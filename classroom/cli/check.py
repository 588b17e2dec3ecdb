"""``slamlab check NOTEBOOK``: check an exercise notebook as grading does, without grading it."""

from pathlib import Path

from slamlab.cli.common import refuse
from slamlab.cli.parsers import add_command


def add_parser(subparsers):
    parser = add_command(
        subparsers,
        "check",
        "Check an exercise notebook as grading does, without grading it.",
        "exercises/ex04_models_and_jacobians.ipynb",
        "copy.ipynb --exercise 04",
    )
    parser.add_argument("notebook", metavar="NOTEBOOK", type=Path, help="Notebook to check")
    exercise = "Exercise, such as 04, if the notebook does not name it"
    parser.add_argument("--exercise", metavar="ID", help=exercise)
    parser.set_defaults(run=run)


def run(arguments) -> int:
    """Return 0 if all tasks pass, 1 if one does not, 2 if the notebook cannot be checked."""
    from classroom.checks import validation
    from classroom.exercises import catalogue

    try:
        if arguments.exercise is not None:
            catalogue.exercise(arguments.exercise)
        return 0 if validation.validate(arguments.notebook, arguments.exercise) else 1
    except (validation.ValidationError, KeyError) as error:
        return refuse("check", error)
