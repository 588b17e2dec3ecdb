"""Whose a submission is: the roster joined to the place that an LMS, or the lecturer, named.

A student names files; folders of a download, and what stands before a file's name in it, he does
not. What fits nobody is graded all the same, and listed as such.
"""

from collections import defaultdict
from dataclasses import replace

from slamlab.grading.term.lms_names import MOODLE, lms_name
from slamlab.grading.term.roster import RosterError

STRANGER = "not in the roster: "
"""Before the name of somebody who is not; no id begins so."""


def joined(found, roster, worksheet=None):
    """Join submissions to the roster: from then on the student is his id.

    Parameters
    ----------
    found : list of Submission
    roster : Roster
    worksheet : Worksheet or None, of the assignment that Moodle's download is of

    Returns
    -------
    list of Submission
    """
    made = [_joined(submission, roster, worksheet) for submission in found]
    numbers = defaultdict(set)
    for submission in made:
        if submission.student in roster.students:
            numbers[submission.student] |= _participant(submission)
    return [_unless_claimed_twice(s, numbers[s.student], roster) for s in made]


def check_worksheet(found, worksheet, file):
    """Check that a worksheet is of the download that it is given with.

    Parameters
    ----------
    found : list of Submission
    worksheet : Worksheet
    file : Path, its own

    Raises
    ------
    RosterError : none of the download's participants stands in it
    """
    numbers = set().union(*map(_participant, found))
    if numbers and numbers.isdisjoint(worksheet.rows):
        raise RosterError(
            f"{file}: none of the download's participants stands in it, such as {min(numbers)}: "
            "it is of another assignment"
        )


def _participant(submission):
    """Moodle's number of whose it is, alone in a set; empty for what is not Moodle's."""
    of_lms = lms_name(submission.name)
    return {of_lms.number} if of_lms and of_lms.lms == MOODLE else set()


def _joined(submission, roster, worksheet):
    of_lms = lms_name(submission.name)
    when = submission.when
    if of_lms is None:
        student = _by_any_name(submission.student, roster)
    elif of_lms.lms == MOODLE:
        by_sheet = worksheet and of_lms.number in worksheet.rows
        student = (worksheet.student(of_lms.number, roster) if by_sheet
                   else roster.find(name=of_lms.student))  # fmt: skip
        when = (worksheet.handed_in(of_lms.number) if by_sheet else None) or ""
    else:
        student = roster.find(canvas=of_lms.number)
        when = ""  # a download's files were written when it was made
    who = student.id if student else STRANGER + submission.student
    return replace(submission, student=who, when=when)


def _by_any_name(name, roster):
    ways = ({"id": name}, {"email": name}, {"name": name})
    return next(filter(None, (roster.find(**way) for way in ways)), None)


def _unless_claimed_twice(submission, numbers, roster):
    if len(numbers) < 2 or not _participant(submission):
        return submission
    name = roster.students[submission.student].name
    said = f"the participants {', '.join(sorted(numbers))} are all called {name}"
    who = f"{STRANGER}{name} (participant {min(_participant(submission))})"
    return replace(submission, student=who, problem=f"{said}: say whose it is by --worksheet")
