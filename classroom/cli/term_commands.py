"""``slamlab grade init`` and ``release``: begin a term, and release the results of an exercise."""

import argparse
import hashlib
import os
from pathlib import Path

from classroom.cli.common import COURSE, add_who_option, answered, exercise_of, term_of
from slamlab.cli.common import printable
from slamlab.cli.parsers import UsageError, add_command

TEMPLATE = """\
# Course file of this term, for slamlab grade. Paths are relative to this folder.
name = "SLAM"
time_zone = "{zone}"      # for times shown to students and for times here without a zone
roster = "roster.csv"           # id,name,email,section; or Moodle's or Canvas' own export
results = "results"             # tables, feedback, gradebook
# secret = "results/secret"     # seed of random inputs; created at the first run
isolation = "strict"            # or "basic"; docs/grading.md lists the requirements
attempts = "last"               # or "best": which attempt of a student counts
# gradebook = "postgresql+psycopg://me@host/course"   # default: results/grades.db

[late]
grace_minutes = 10
per_day = 0.1                   # of the points earned, for each started day
at_most = 0.5

# The exercises that are graded. To extend the due date of a student, use the roster (a column
# named after the exercise) or these lines:
# [extensions.04]
# s123 = 2026-12-05T23:59:00
{exercises}"""
EXERCISE = """
[exercises.{id}]                  # {title}
# due = 2026-12-01T23:59:00
# canvas = "{title} (12345)"
"""


def add_parser(subparsers):
    description = "Write a course file, course.toml, for a new term."
    init = add_command(subparsers, "grade init", description, ".", "slam-2027")
    folder = "Folder of the term (default: this folder)"
    init.add_argument("folder", metavar="DIR", type=Path, nargs="?", default=Path(), help=folder)
    init.set_defaults(run=run, verb="init")
    description = "Write an exercise's results for the students and the LMS."
    release = add_command(subparsers, "grade release", description, "04", "04 --as 'Prof. X'")
    release.add_argument("exercise", metavar="ID", help="Exercise, such as 04")
    release.add_argument("--course", metavar="FILE", type=Path, help=COURSE)
    release.add_argument("--out", help=argparse.SUPPRESS)  # is refused with the remedy
    help = "Folder of a JupyterHub's homes: also write each student's feedback there"
    release.add_argument("--homes", metavar="DIR", type=Path, dest="users", help=help)
    add_who_option(release)
    release.set_defaults(run=run, verb="release", db=None, policy=None)


def run(arguments) -> int:
    """Run the command and return 0, or 2 for wrong usage."""
    from classroom.grading.gradebook import GradebookError
    from classroom.grading.term.course_file import TermError

    def act():
        print({"init": _init, "release": _release}[arguments.verb](arguments))
        return 0

    refusals = (UsageError, TermError, GradebookError, KeyError)
    return answered(f"grade {arguments.verb}", refusals, act)


def _init(arguments):
    from classroom.exercises import catalogue
    from classroom.grading.term.course_file import NAME

    file = arguments.folder / NAME
    if file.exists():
        raise UsageError(f"{file} already exists. Edit it, or name another folder")
    known = [catalogue.exercise(id) for id in catalogue.EXERCISES]
    exercises = "".join(EXERCISE.format(id=e.id, title=e.title) for e in known)
    arguments.folder.mkdir(parents=True, exist_ok=True)
    file.write_text(TEMPLATE.format(zone=_zone_here(), exercises=exercises), "utf-8")
    return (
        f"{file} is written. Fill in the due dates, delete the exercises that are not graded, and "
        "put the roster in the same folder."
    )


def _zone_here():
    zone = os.environ.get("TZ", "") or os.path.realpath("/etc/localtime").partition("zoneinfo/")[2]
    return zone if "/" in zone and not zone.startswith((":", "/")) else "Europe/Zagreb"


def _release(arguments):
    from classroom.grading.gradebook import Gradebook, default_url
    from classroom.grading.term import course_file, releases
    from classroom.grading.term.term import undecided

    if arguments.out or not (arguments.course or Path(course_file.NAME)).exists():
        raise UsageError(
            "a release needs a course file. Write one with slamlab grade init, and grade again in "
            "its folder; without one, give the pages in DIR/feedback to the students"
        )
    term = term_of(arguments)
    id = exercise_of(term, arguments.exercise)
    url = arguments.db or default_url(arguments.out, new=False)
    with Gradebook(url, arguments.who) as book:
        mine, removed = term.exercise_results(book)[id], term.removed_students(book)
        unmatched = term.unmatched([r for r in book.latest_attempts() if r.exercise == id])
        if (removed or unmatched) and not any(result.mark for result in mine):
            raise UsageError(". ".join([*unmatched, *removed]))
        term.write(book, {id})
        notes = releases.release(term.course, term.roster, id, mine, term.worksheet(id))
        folder = term.course.results / id / "release"
        table = hashlib.sha256((folder / "grades.csv").read_bytes()).hexdigest()
        head = book.note("release", {"exercise": id, "grades.csv": table})
    ledger = f"ledger {head['chain']}, row {head['number']}: {head['hash']}"
    lines = [f"exercise {id} released: {folder}", *notes, *undecided(mine), *unmatched, *removed]
    if arguments.users:
        from classroom.hub import exchange

        lines += exchange.give_back(term.roster.students, arguments.users, id, folder / "feedback")
    return "\n".join(map(printable, [*lines, ledger]))
