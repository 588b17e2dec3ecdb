"""State of a class: a copy of the gradebook in memory, for fast responses.

Rows that other processes add are read before every response; only a new attempt causes all attempts
to be reloaded."""

from functools import cached_property

from classroom.exercises import catalogue
from classroom.grading import class_report, remarks
from classroom.grading.ledger import chains
from classroom.grading.similarity.similarity_report import compare_submissions


class ClassState:
    """Snapshot of a class (Term, Gradebook); raises GradebookError if it cannot be read."""

    def __init__(self, term, book):
        self.term, self.book = term, book
        self.students = list(term.roster.students.values())
        # loaded now, so that the first response is fast
        self.exercises = [catalogue.exercise(id) for id in term.course.exercises]
        self._similarity = {}  # exercise to the records compared and their report
        self._load()

    def refresh(self):
        """Read the rows that were added to the gradebook since the last refresh."""
        new = self.book.rows(after=self._newest)
        if any(row["kind"] not in (*remarks.KINDS, "release") for row in new):
            self._load()
        elif new:
            self._newest = max(row["id"] for row in new)
            known = {row["id"] for row in self._rows}
            self._take([*self._rows, *(row for row in new if row["id"] not in known)])

    def _load(self):
        self._newest = self.book.newest_row()  # rows added meanwhile are read again
        self._records = list(self.book.attempts().values())
        self._take(self.book.rows(kinds=remarks.KINDS))

    def _take(self, rows):
        self._rows = [
            row for row in rows if row["kind"] in remarks.KINDS and row["body"] is not None
        ]
        contents = [(row, chains.loaded(row)) for row in self._rows]
        by_kind = {kind: [] for kind in remarks.KINDS}
        self._history = {}  # (submission, exercise) to (row, body), the oldest first
        for row, body in contents:
            by_kind[row["kind"]].append(body)
            place = body["submission"], body["exercise"]
            self._history.setdefault(place, []).append((row, body))
        overrides = remarks.overrides_of(by_kind[remarks.OVERRIDE])
        kinds = (remarks.COMMENT, remarks.REQUEST, remarks.ANSWER)
        notes = remarks.of_attempts(*(by_kind[kind] for kind in kinds))
        self.answers = {body["request"]: body["text"] for body in by_kind[remarks.ANSWER]}
        self.requests = {body["request"]: body for body in by_kind[remarks.REQUEST]}
        self.exercise_results = self.term.exercise_results_of(self._records, overrides, notes)
        self.__dict__.pop("mistakes", None)

    def history_of(self, result):
        """Return the changes by hand of all attempts as (row, body), the oldest first."""
        places = [(name, result.exercise) for name in result.submissions]
        found = [change for place in places for change in self._history.get(place, [])]
        return sorted(found, key=lambda change: change[0]["id"])

    @cached_property
    def mistakes(self):
        """Map from each task to its TaskReport over the attempts that count."""
        found = {}
        for id, exercise_results in self.exercise_results.items():
            records = [s.mark.record for s in exercise_results if s.mark and s.mark.record.graded]
            for task in catalogue.exercise(id).tasks:
                found[task.id] = class_report.task_report(task, records)
        return found

    def similarity(self, exercise):
        """Return the SimilarityReport of the attempts that count; this is slow if the attempts have
        changed."""
        records = [s.mark.record for s in self.exercise_results[exercise] if s.mark]
        before, found = self._similarity.get(exercise, (None, None))
        if before != records:
            found = compare_submissions(self.book, {record.student: record for record in records})
            self._similarity[exercise] = records, found
        return found

    def requests_of(self, student, exercise):
        place = student, exercise
        return [b for b in self.requests.values() if (b["student"], b["exercise"]) == place]
