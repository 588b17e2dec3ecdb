"""The state of a class: what the gradebook holds, kept in memory so that a page answers at once.

Rows that somebody else adds meanwhile are taken in before every answer. Most are few and by hand;
only a new attempt makes all attempts be read again.
"""

from functools import cached_property

from slamlab.exercises import catalogue
from slamlab.grading import class_report, remarks
from slamlab.grading.ledger import chains
from slamlab.grading.likeness.kept_submissions import likeness_of

OVERRIDE = "override"
BY_HAND = (OVERRIDE, *remarks.KINDS)


class ClassState:
    """What is known of a class at one moment.

    Parameters
    ----------
    term : Term
    book : Gradebook

    Raises
    ------
    GradebookError : here and from ``refresh``
    """

    def __init__(self, term, book):
        self.term, self.book = term, book
        self.students = list(term.roster.students.values())
        # loaded now, so that the first page does not wait for it
        self.exercises = [catalogue.exercise(id) for id in term.course.exercises]
        self._likeness = {}  # exercise to the records that were compared, and their likeness
        self._load()

    def refresh(self):
        """Take in what was added to the gradebook since."""
        new = self.book.rows(after=self._newest)
        if any(row["kind"] not in (*BY_HAND, "release") for row in new):
            self._load()
        elif new:
            self._newest = max(row["id"] for row in new)
            known = {row["id"] for row in self._rows}
            self._take([*self._rows, *(row for row in new if row["id"] not in known)])

    def _load(self):
        self._newest = self.book.newest_row()  # what comes while it is read is read once more
        self._records = list(self.book.attempts().values())
        self._take(self.book.rows(kinds=BY_HAND))

    def _take(self, rows):
        self._rows = [row for row in rows if row["kind"] in BY_HAND and row["body"] is not None]
        told = [(row, chains.loaded(row)) for row in self._rows]
        by_kind = {kind: [] for kind in BY_HAND}
        self.history = {}  # submission to (row, what it says), the oldest first
        for row, body in told:
            by_kind[row["kind"]].append(body)
            self.history.setdefault(body["submission"], []).append((row, body))
        overrides = {
            (body["submission"], body["task"]): (body["points"], body["reason"])
            for body in by_kind[OVERRIDE]
        }
        said = remarks.of_submissions(*(by_kind[kind] for kind in remarks.KINDS))
        self.answers = {body["request"]: body["text"] for body in by_kind[remarks.ANSWER]}
        self.requests = {body["request"]: body for body in by_kind[remarks.REQUEST]}
        self.standings = self.term.standings_of(self._records, overrides, said)
        self.__dict__.pop("mistakes", None)

    @cached_property
    def mistakes(self):
        """Task to its TaskReport over the attempts that count."""
        found = {}
        for id, standings in self.standings.items():
            records = [s.mark.record for s in standings if s.mark and s.mark.record.graded]
            for task in catalogue.exercise(id).tasks:
                found[task.id] = class_report.task_report(task, records)
        return found

    def likeness(self, exercise):
        """The likeness of the attempts that count; takes seconds, where they are others now.

        Parameters
        ----------
        exercise : str

        Returns
        -------
        Likeness
        """
        records = [s.mark.record for s in self.standings[exercise] if s.mark]
        before, found = self._likeness.get(exercise, (None, None))
        if before != records:
            found = likeness_of(self.book, {record.student: record for record in records})
            self._likeness[exercise] = records, found
        return found

    def requests_of(self, student, exercise):
        """The requests of a student for another look at an exercise, in order.

        Parameters
        ----------
        student, exercise : str

        Returns
        -------
        list of dict
        """
        place = student, exercise
        return [b for b in self.requests.values() if (b["student"], b["exercise"]) == place]
