"""``slamlab grade lti``: the roster from an LMS, and grades back into it, by LTI Advantage."""

import json
import sys
from datetime import UTC, datetime
from pathlib import Path

from slamlab.cli.common import COURSE, UsageError, add_who_option
from slamlab.cli.grade_output import printable


def add_parser(subparsers):
    """Add the command to the command line; it is a word behind ``grade``."""
    parser = subparsers.add_parser(
        "grade lti",
        description=(
            "Talk to the LMS of [lti] in the course file by LTI Advantage's services. key: make "
            "the key, and print the public part that the LMS wants; roster: write the roster; "
            "passback: send the scores of an exercise that were released."
        ),
    )
    parser.add_argument("what", choices=("key", "roster", "passback"))
    parser.add_argument("exercise", metavar="ID", nargs="?", help="of passback, such as 04")
    parser.add_argument("--course", metavar="FILE", type=Path, help=COURSE)
    add_who_option(parser)
    parser.set_defaults(run=run)


def run(arguments) -> int:
    """Do it; 0 when done, 1 when some scores were not sent, 2 for wrong use or no LMS."""
    from slamlab.grading.gradebook import GradebookError
    from slamlab.grading.term import course_file
    from slamlab.grading.term.course_file import TermError

    try:
        if (arguments.what == "passback") != (arguments.exercise is not None):
            raise UsageError("passback, and nothing else, needs an exercise: lti passback 04")
        file = arguments.course or Path(course_file.NAME)
        if not file.exists():
            raise UsageError("LTI needs a course file: slamlab grade init")
        course = course_file.load(file)
        if course.lti is None:
            raise UsageError(f"{file} has no table [lti]; docs/grading.md says what stands there")
        did = {"key": _key, "roster": _roster, "passback": _passback}[arguments.what]
        lines, code = did(arguments, course, file)
        print("\n".join(map(printable, lines)))
        return code
    except (UsageError, TermError, GradebookError, KeyError) as error:
        print(f"slamlab grade lti: {printable(str(error.args[0]))}", file=sys.stderr)
    except OSError as error:
        print(f"slamlab grade lti: {error.filename}: {error.strerror}", file=sys.stderr)
    return 2


def _key(arguments, course, file):
    from slamlab.grading.lti.keys import load_key, public_key

    jwk, pem = public_key(load_key(course.lti.key, make=True))
    return [f"{course.lti.key} stays here. For the LMS, as JWK:", json.dumps(jwk),
            "or as PEM:", *pem.splitlines()], 0  # fmt: skip


def _roster(arguments, course, file):
    from slamlab.grading.grade_tables import write_table
    from slamlab.grading.lti.names_and_roles import find_member, learners, roster_rows
    from slamlab.grading.lti.service import Service
    from slamlab.grading.term import roster

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
    lines = [f"{course.roster} is there, and stays as it is; move it away to have it written anew"]
    lines += [f"in the LMS only: {'; '.join(new)}"] if new else []
    lines += [f"not in the LMS, or not as one: {'; '.join(gone)}"] if gone else []
    return lines, 0


def _passback(arguments, course, file):
    from slamlab.exercises import catalogue
    from slamlab.grading.gradebook import Gradebook, default_url
    from slamlab.grading.lti import grade_passback
    from slamlab.grading.lti.names_and_roles import learners
    from slamlab.grading.lti.service import Service
    from slamlab.grading.term.released_scores import released_scores
    from slamlab.grading.term.term import load

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
    return lines + [f"not sent: {line}" for line in left_out], 1 if left_out else 0
