"""``slamlab grade init`` and ``release``: begin a term, give an exercise's results back."""

import hashlib
import os
import sys
from pathlib import Path

from slamlab.cli.common import COURSE, UsageError, add_who_option, exercise_of, term_of
from slamlab.cli.grade_output import printable

VERBS = ("init", "release")
TEMPLATE = """\
# What every slamlab grade command of this term reads. Places are seen from this folder.
name = "SLAM"
time_zone = "{zone}"      # of all times here that tell none, and of those shown to students
roster = "roster.csv"           # id,name,email,section; or Moodle's or Canvas' own export
results = "results"             # tables, feedback, gradebook
# secret = "results/secret"     # what inputs are drawn from; made at the first run
isolation = "strict"            # or "basic"; docs/grading.md says what they need
attempts = "last"               # or "best": which of a student's attempts counts
# gradebook = "postgresql+psycopg://me@host/course"   # default: results/grades.db

[late]
grace_minutes = 10
per_day = 0.1                   # of the points earned, for every day begun
at_most = 0.5

# The exercises that are graded. An extension for a student stands in the roster, in a column
# called as the exercise, or here:
# [extensions.04]
# s123 = 2026-12-05T23:59:00
{exercises}"""
EXERCISE = """
[exercises.{id}]                  # {title}
# due = 2026-12-01T23:59:00
# canvas = "{title} (12345)"
"""


def add_parser(subparsers):
    """Add the commands to the command line; they are words behind ``grade``."""
    init = subparsers.add_parser(
        "grade init", description="Write a course file, course.toml, to be filled in."
    )
    init.add_argument(
        "folder",
        metavar="DIR",
        type=Path,
        nargs="?",
        default=Path(),
        help="where; default: the folder you are in",
    )
    init.set_defaults(run=run, verb="init")
    release = subparsers.add_parser(
        "grade release",
        description="Write what goes back: tables and feedback as Moodle and Canvas take them in.",
    )
    release.add_argument("exercise", metavar="ID", help="such as 04")
    release.add_argument("--course", metavar="FILE", type=Path, help=COURSE)
    add_who_option(release)
    release.set_defaults(run=run, verb="release", out=None, db=None, policy=None)


def run(arguments) -> int:
    """Begin a term, or release an exercise; 0 when done, 2 for wrong use."""
    from slamlab.grading.gradebook import GradebookError
    from slamlab.grading.term.course_file import TermError

    try:
        print({"init": _init, "release": _release}[arguments.verb](arguments))
    except (UsageError, TermError, GradebookError, KeyError) as error:
        print(f"slamlab grade {arguments.verb}: {error.args[0]}", file=sys.stderr)
        return 2
    except OSError as error:
        said = f"{error.filename}: {error.strerror}"
        print(f"slamlab grade {arguments.verb}: {said}", file=sys.stderr)
        return 2
    return 0


def _init(arguments):
    from slamlab.exercises import catalogue
    from slamlab.grading.term.course_file import NAME

    file = arguments.folder / NAME
    if file.exists():
        raise UsageError(f"{file} is there already")
    known = [catalogue.exercise(id) for id in catalogue.EXERCISES]
    exercises = "".join(EXERCISE.format(id=e.id, title=e.title) for e in known)
    arguments.folder.mkdir(parents=True, exist_ok=True)
    file.write_text(TEMPLATE.format(zone=_zone_here(), exercises=exercises), "utf-8")
    return (
        f"{file}: fill in due dates, take out exercises that are not graded, and put the roster "
        "beside it"
    )


def _zone_here():
    """The name of this machine's time zone, as far as it tells."""
    told = os.environ.get("TZ", "") or os.path.realpath("/etc/localtime").partition("zoneinfo/")[2]
    return told if "/" in told and not told.startswith((":", "/")) else "Europe/Zagreb"


def _release(arguments):
    from slamlab.grading.gradebook import Gradebook, default_url
    from slamlab.grading.term import course_file, releases

    if not (arguments.course or Path(course_file.NAME)).exists():
        raise UsageError("a release needs a course file: slamlab grade init")
    term = term_of(arguments)
    id = exercise_of(term, arguments.exercise)
    url = arguments.db or default_url(arguments.out, new=False)
    with Gradebook(url, arguments.who) as book:
        mine, gone = term.standings(book)[id], term.gone(book)
        if gone and not any(standing.mark for standing in mine):
            raise UsageError(gone[0])
        said = releases.release(term.course, term.roster, id, mine, term.worksheet(id))
        place = term.course.results / id / "release"
        table = hashlib.sha256((place / "grades.csv").read_bytes()).hexdigest()
        head = book.note("release", {"exercise": id, "grades.csv": table})
    told = f"ledger {head['chain']}, row {head['number']}: {head['hash']}"
    lines = [f"exercise {id} released: {place}", *said, *gone, told]
    return "\n".join(map(printable, lines))
