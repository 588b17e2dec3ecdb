"""Match submissions to students of the roster, by the folder or file-name prefix that an LMS or the
lecturer chose. Students choose only the rest of a file's name, which does not count.
"""

from collections import defaultdict
from dataclasses import replace

from classroom.grading.term.lms_names import MOODLE, lms_name
from classroom.grading.term.roster import RosterError

NOT_IN_ROSTER, SEVERAL_IN_ROSTER = UNMATCHED = "not in the roster: ", "several in the roster: "
"""Prefixes of names that match no student or several students; ids must not begin with a prefix."""


def match_students(found, roster, worksheet=None):
    """Return submissions with each matched student replaced by an id of the roster. ``worksheet``
    is Moodle's grading worksheet of the assignment.
    """
    made = [_match(submission, roster, worksheet) for submission in found]
    numbers = defaultdict(set)
    for submission in made:
        if submission.student in roster.students:
            numbers[submission.student] |= _participant(submission)
    return [_unless_claimed_twice(s, numbers[s.student], roster) for s in made]


def check_worksheet(found, worksheet, file):
    """Raise RosterError if the worksheet contains no participant of the download."""
    numbers = set().union(*map(_participant, found))
    if numbers and numbers.isdisjoint(worksheet.rows):
        raise RosterError(
            f"{file} belongs to another assignment: it contains none of the download's "
            f"participants, such as {min(numbers)}"
        )


def _participant(submission):
    """Return a set with Moodle's participant number, or an empty set if there is none."""
    of_lms = lms_name(submission.name)
    return {of_lms.number} if of_lms and of_lms.lms == MOODLE else set()


def _match(submission, roster, worksheet):
    of_lms = lms_name(submission.name)
    when = submission.when
    if of_lms is None:
        found = roster.find_any(submission.student)
    elif of_lms.lms == MOODLE:
        by_sheet = worksheet and of_lms.number in worksheet.rows
        student = by_sheet and worksheet.student(of_lms.number, roster)
        found = [student] if student else roster.find_all(name=of_lms.student)
        found = [] if by_sheet and not student and len(found) == 1 else found
        when = (worksheet.handed_in(of_lms.number) if by_sheet else None) or ""
    else:
        found = roster.find_all(canvas=of_lms.number)
        when = ""  # files of a download have the time of the download
    if len(found) == 1:
        return replace(submission, student=found[0].id, when=when)
    participant = f" (participant {min(number)})" if (number := _participant(submission)) else ""
    who = f"{submission.student}{participant}"
    if found:
        who = f"{SEVERAL_IN_ROSTER}{who} is {' or '.join(student.id for student in found)}"
    else:
        who = f"{NOT_IN_ROSTER}{who}"
    return replace(submission, student=who, when=when)


def _unless_claimed_twice(submission, numbers, roster):
    if len(numbers) < 2 or not _participant(submission):
        return submission
    name = roster.students[submission.student].name
    problem = (
        f"the participants {', '.join(sorted(numbers))} all have the name {name}; "
        "grade with --worksheet"
    )
    who = f"{NOT_IN_ROSTER}{name} (participant {min(_participant(submission))})"
    return replace(submission, student=who, problem=problem)
