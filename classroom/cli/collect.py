"""``slamlab collect``: copy the submissions of an exercise from the homes of students."""

from pathlib import Path

from classroom.cli.common import COURSE, answered, exercise_of, term_of
from slamlab.cli.common import FAILED, printable
from slamlab.cli.parsers import add_command


def add_parser(subparsers):
    description = "Copy an exercise's notebooks from the homes of a JupyterHub."
    parser = add_command(subparsers, "collect", description, "04", "04 --homes /exchange")
    add = parser.add_argument
    add("exercise", metavar="ID", help="Exercise, such as 04")
    help = "Folder that contains the homes (default: /home)"
    add("--homes", metavar="DIR", type=Path, default=Path("/home"), dest="users", help=help)
    into = "Folder for the notebooks (default: submissions)"
    add("--into", metavar="DIR", type=Path, default=Path("submissions"), help=into)
    add("--course", metavar="FILE", type=Path, help=COURSE)
    parser.set_defaults(run=run, out=None, db=None, policy=None)


def run(arguments) -> int:
    """Return 0 if the homes of all students were read, 1 if some were not, 2 for wrong usage."""
    from classroom.grading.term.course_file import NAME, TermError
    from classroom.hub import exchange

    def act():
        term = term_of(arguments) if arguments.course or Path(NAME).exists() else None
        id = exercise_of(term, arguments.exercise)
        students = term.roster.students if term else exchange.users_in(arguments.users)
        new, same, problems = exchange.collect(students, arguments.users, id, arguments.into)
        for line in problems:
            print(f"not collected: {printable(line)}")
        print(f"{new} new or changed notebooks, {same} unchanged: {arguments.into}")
        return FAILED if problems else 0

    return answered("collect", (TermError, KeyError, ValueError), act)
