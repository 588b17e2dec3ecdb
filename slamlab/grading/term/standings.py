"""Standings: for each student and exercise the attempt that counts, and who handed in nothing."""

from collections import defaultdict
from dataclasses import dataclass
from datetime import datetime

from slamlab.exercises import catalogue
from slamlab.grading.marks import Mark
from slamlab.grading.term.lms_names import lms_name
from slamlab.grading.term.roster import Student


@dataclass(frozen=True)
class Standing:
    """How a student stands in an exercise.

    Parameters
    ----------
    student : Student
    exercise : str
    mark : Mark or None, of the attempt that counts; None where nothing was handed in
    attempts : int, how many there are
    unread : int, how many of them could not be graded
    due : datetime or None, for this student
    """

    student: Student
    exercise: str
    mark: Mark | None
    attempts: int
    unread: int
    due: datetime | None

    @property
    def status(self):
        """One word or two for the tables."""
        if self.mark is None:
            return "nothing handed in"
        return "could not be graded" if self.mark.total is None else "graded"

    @property
    def of_download(self):
        """What the LMS wrote into the name of the attempt that counts; None without any."""
        return lms_name(self.mark.record.submission) if self.mark else None

    @property
    def total(self):
        """Points after overrides and lateness; None where there is no score."""
        return self.mark.total if self.mark else None


def standings(course, roster, marks, policy):
    """The standings of a term.

    Parameters
    ----------
    course : Course
    roster : Roster
    marks : list of Mark, of all attempts, in the gradebook's order
    policy : LatePolicy

    Returns
    -------
    dict, exercise to list of Standing in the roster's order
    """
    attempts = defaultdict(list)
    for order, made in enumerate(_newest_of_each_content(marks)):
        attempts[made.record.student, made.record.exercise].append((order, made))
    found = {}
    for id in course.exercises:
        found[id] = []
        for student in roster.students.values():
            mine = attempts.get((student.id, id), [])
            counted = _counted(mine, course.attempts)
            unread = sum(made.total is None for _, made in mine)
            due = policy.due_for(id, student.id)
            found[id].append(Standing(student, id, counted, len(mine), unread, due))
    return found


def points_of(exercise):
    """The most that can be earned in an exercise."""
    return catalogue.exercise(exercise).points


def _counted(attempts, rule):
    """The mark of the attempt that counts; one without a score only where no other has one."""
    scored = [pair for pair in attempts if pair[1].total is not None]
    best = (lambda pair: (pair[1].total, *_when(pair))) if rule == "best" else _when
    return max(scored or attempts, key=best, default=(0, None))[1]


def _when(pair):
    """The order of attempts: that in which the judge first saw them, by no clock."""
    order, made = pair
    return made.record.seen or 0, order


def _newest_of_each_content(marks):
    """Of the same content under the same name, in an exercise, only what was made of it last.

    What could not be graded gives way to all that is made of it later; what was graded as one
    exercise stays, whatever other exercise the same file is taken for.
    """
    newest, last = {}, {}
    for made in marks:
        content = made.record.submission, made.record.sha256
        key, before = (*content, made.record.exercise), last.get(content)
        if before in newest and newest[before].record.reason:
            newest.pop(before)
        newest.pop(key, None)
        newest[key], last[content] = made, key
    return newest.values()
