"""Options, term and exercise of the commands that use a gradebook."""

import sys
from pathlib import Path

from slamlab.cli.common import printable, refuse
from slamlab.cli.parsers import UsageError

COURSE = "Course file (default: course.toml in this folder, without --out)"
EXERCISES = "Exercises, such as 04 (default: all)"
ISOLATION = "Sandbox of student code: strict, basic or none; see docs/grading.md (default: strict)"


def add_course_options(parser, policy=True):
    """Add the options of every command that uses a gradebook."""
    parser.add_argument("--course", metavar="FILE", type=Path, help=COURSE)
    out = "Folder of the results (default: as in the course file)"
    parser.add_argument("--out", metavar="DIR", type=Path, help=out)
    db = "SQLAlchemy URL of the gradebook's database (default: SQLite in DIR/grades.db)"
    parser.add_argument("--db", metavar="URL", help=db)
    add_who_option(parser)
    if policy:
        help = "TOML file of the late policy, if there is no course file; see docs/grading.md"
        parser.add_argument("--policy", metavar="FILE", type=Path, help=help)


def add_who_option(parser):
    who = "Author of the changes (default: account of the database or of this machine)"
    parser.add_argument("--as", metavar="NAME", dest="who", help=who)


def add_isolation_option(parser, default=None):
    choices = ("strict", "basic", "none")
    parser.add_argument(
        "--isolation", metavar="LEVEL", choices=choices, default=default, help=ISOLATION
    )


def answered(command, refusals, act) -> int:
    """Return the exit code of ``act()``; for a refusal or an OSError, print it and return 2."""
    try:
        return act()
    except (*refusals, OSError) as error:
        return refuse(command, error)


def term_of(arguments):
    """Return a command's term, or None, and fill in missing options from the term.

    Raises UsageError, TermError."""
    from classroom.grading.term import course_file, term

    file = arguments.course or Path(course_file.NAME)
    if arguments.course is None and (arguments.out or not file.exists()):
        if arguments.out is None:
            why = (
                "there is no course file here. Write one with slamlab grade init, or give --out DIR"
            )
            raise UsageError(why)
        return None
    for option in ("out", "policy"):
        if getattr(arguments, option):
            raise UsageError(
                f"{file} also sets --{option}. Leave out the option or the course file"
            )
    found = term.load(file)
    for warning in found.warnings:
        print(f"warning: {printable(warning)}", file=sys.stderr)
    arguments.out = found.course.results
    arguments.db = arguments.db or found.course.gradebook
    return found


def exercise_of(term, id):
    """Return the id of an exercise, "04" for "4". Raises KeyError, UsageError."""
    from classroom.exercises import catalogue

    id = catalogue.exercise(id).id
    if term and id not in term.course.exercises:
        known = ", ".join(term.course.exercises)
        raise UsageError(f"the course file has no exercise {id}. It has the exercises {known}")
    return id
