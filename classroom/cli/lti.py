"""``slamlab grade lti``: roster from an LMS and grade passback to the LMS by LTI Advantage."""

import json
from datetime import UTC, datetime
from pathlib import Path

from classroom.cli.common import COURSE, add_who_option
from slamlab.cli.common import FAILED, printable, refuse
from slamlab.cli.parsers import UsageError, add_command


def add_parser(subparsers):
    parser = add_command(
        subparsers,
        "grade lti",
        "Exchange the roster and the grades with an LMS (LTI Advantage).",
        "roster",
        "passback 04",
    )
    what = "Action: key creates the key, roster writes the roster, passback sends released scores"
    choices = ("key", "roster", "passback")
    parser.add_argument("what", metavar="WHAT", choices=choices, help=what)
    exercise = "Exercise whose scores to send by passback, such as 04"
    parser.add_argument("exercise", metavar="ID", nargs="?", help=exercise)
    parser.add_argument("--course", metavar="FILE", type=Path, help=COURSE)
    add_who_option(parser)
    parser.set_defaults(run=run)


def run(arguments) -> int:
    """Return 0 for success, 1 if some scores were not sent, 2 for wrong usage or a missing LMS."""
    from classroom.grading.gradebook import GradebookError
    from classroom.grading.term import course_file
    from classroom.grading.term.course_file import TermError

    try:
        if (arguments.what == "passback") != (arguments.exercise is not None):
            raise UsageError("passback needs an exercise (lti passback 04); the others take none")
        file = arguments.course or Path(course_file.NAME)
        if not file.exists():
            raise UsageError("LTI needs a course file. Write one with slamlab grade init")
        course = course_file.load(file)
        if course.lti is None:
            raise UsageError(f"{file} has no table [lti]. docs/grading.md describes it")
        act = {"key": _key, "roster": _roster, "passback": _passback}[arguments.what]
        lines, code = act(arguments, course, file)
        print("\n".join(map(printable, lines)))
        return code
    except (UsageError, TermError, GradebookError, KeyError, OSError) as error:
        return refuse("grade lti", error)


def _key(arguments, course, file):
    from classroom.grading.lti.keys import load_key, public_key

    jwk, pem = public_key(load_key(course.lti.key, make=True))
    return [f"{course.lti.key} is secret. Give the LMS the public key as JWK:", json.dumps(jwk),
            "or as PEM:", *pem.splitlines()], 0  # fmt: skip


def _roster(arguments, course, file):
    from classroom.grading.grade_tables import write_table
    from classroom.grading.lti.names_and_roles import find_member, learners, roster_rows
    from classroom.grading.lti.service import Service
    from classroom.grading.term import roster

    with Service(course.lti) as service:
        members = learners(service, course.lti.members_url)
    if not course.roster.exists():
        write_table(course.roster, roster_rows(members))
        roster.load(course.roster, course.exercises, course.zone)
        return [f"{course.roster}: {len(members)} students"], 0
    students = roster.load(course.roster, course.exercises, course.zone).students.values()
    known = {id(find_member(members, student)) for student in students}
    new = [m.name or m.email or m.user_id for m in members if id(m) not in known]
    gone = [s.name or s.id for s in students if find_member(members, s) is None]
    lines = [f"{course.roster} exists and was not changed. Move the file away to write a new one"]
    lines += [f"in the LMS only: {'; '.join(new)}"] if new else []
    lines += [f"in the roster, but not a student in the LMS: {'; '.join(gone)}"] if gone else []
    return lines, 0


def _passback(arguments, course, file):
    from classroom.exercises import catalogue
    from classroom.grading.gradebook import Gradebook, default_url
    from classroom.grading.lti import grade_passback
    from classroom.grading.lti.names_and_roles import learners
    from classroom.grading.lti.service import Service
    from classroom.grading.term.releases import released_scores
    from classroom.grading.term.term import load

    exercise, term = catalogue.exercise(arguments.exercise), load(file)
    scores = released_scores(course, exercise.id)
    url = course.gradebook or default_url(course.results, new=False)
    with Gradebook(url, arguments.who) as book, Service(course.lti) as service:
        members = learners(service, course.lti.members_url)
        column = grade_passback.line_item(service, course.lti.line_items_url, exercise)
        words = members, term.roster, scores, datetime.now(UTC)
        sent, left_out = grade_passback.send_scores(service, column, *words)
        book.note("passback", {"exercise": exercise.id, "sent": sent, "of": len(scores)})
    lines = [f"exercise {exercise.id}: {sent} of {len(scores)} scores sent"]
    return lines + [f"not sent: {line}" for line in left_out], FAILED if left_out else 0
