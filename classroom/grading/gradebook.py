"""Gradebook: every attempt and every manual override, stored in an audit ledger. An attempt's key
depends on its content, so that a regrade adds no duplicates. Rows are never rewritten; the last row
with a key is valid.
"""

import json

from classroom.grading import gradebook_migration, gradebook_rows
from classroom.grading import remarks as by_hand
from classroom.grading.database import GradebookError
from classroom.grading.ledger import (
    chain_merging,
    chains,
    content_store,
    student_erasure,
    submission_order,
)
from classroom.grading.ledger.chains import Entry
from classroom.grading.ledger.ledger_book import LedgerBook


class Gradebook(LedgerBook):
    """Attempts and overrides in the ledger of a database. The constructor and every method can
    raise GradebookError.
    """

    def __init__(self, url, who=None):
        super().__init__(url, who)
        self._attempts = None, {}  # the id of the newest row when they were read
        if self._read(gradebook_migration.is_older):
            self._write(lambda connection: gradebook_migration.migrate(connection, self.who))

    def add(self, record):
        """Store an attempt and return whether it is new; a known attempt becomes the newest."""
        return self.add_all([record]) == 1

    def add_all(self, records, why=None):
        """Store all attempts in one transaction; return the number of new ones. If ``why`` is
        given, known attempts keep their positions in the order.
        """
        entries = [_attempt(record, why) for record in records]
        kept = {name: data for record in records for name, data in record.contents.items()}

        def added(connection):
            new, changed = 0, []
            known = chains.bodies_of(connection, "attempt", {one.submission for one in entries})
            for entry in entries:
                before = _newest_of_each(known.get(entry.submission, ()))
                key, record = entry.body["key"], json.loads(entry.text)["record"]
                new += key not in before
                if before.get(key) != record or not (why or key == list(before)[-1]):
                    changed.append(entry)
            chains.append(connection, changed, self.who)
            content_store.store(connection, kept)
            return new

        return self._write(added)

    def merge(self, other):
        """Merge another gradebook into this one; return the number of new attempts."""
        theirs = other.rows()
        seen = other._read(submission_order.listed)
        named = {name for record in other.attempts().values() for name in record.kept.values()}
        kept = other.contents(named)
        before = len(self.attempts())

        def merged(connection):
            chain_merging.merge(connection, theirs, self.who)
            content_store.store(connection, kept)
            content_store.drop_unnamed(connection)  # contents of students erased here
            submission_order.merge(connection, seen)

        self._write(merged)
        return len(self.attempts()) - before

    def attempts(self):
        """Return all attempts as a dict from key to Record, oldest first."""
        newest = self.newest_row()  # before the attempts, so that later rows are read next time
        if self._attempts[0] != newest:
            found = self._read(lambda connection: chains.bodies(connection, "attempt"))
            plain = _newest_of_each(found).items()
            self._attempts = newest, {k: gradebook_rows.stored_record(r) for k, r in plain}
        return dict(self._attempts[1])

    def latest_attempts(self):
        """Return the latest record of each submission and exercise, sorted by submission. An
        ungraded record counts until a later attempt is graded. If the record's exercise is unknown,
        the exercise of the previous attempt applies.
        """
        newest = {}
        for record in reversed(self.attempts().values()):
            mine = newest.setdefault(record.submission, {})
            if [*mine] == [None]:
                mine[record.exercise] = mine.pop(None)
            elif record.graded or not mine:
                mine.setdefault(record.exercise, record)
        return [one for name in sorted(newest) for one in reversed(newest[name].values())]

    def change(self, kind, record, **body):
        """Store a change by hand of an attempt: one of :data:`remarks.KINDS`."""
        self.note(kind, body | {"sha256": record.sha256}, record.submission)

    def override_points(self, record, task, points, reason):
        """Set a task's points by hand, or to the autograder's again if ``points`` is None."""
        points = None if points is None else float(points)
        body = {"task": task, "points": points, "reason": reason}
        self.change(by_hand.OVERRIDE, record, exercise=task[:2], **body)

    def overrides(self):
        """See :func:`remarks.overrides_of`."""
        return by_hand.overrides_of(self.notes(by_hand.OVERRIDE))

    def remarks(self):
        """See :func:`remarks.of_attempts`."""
        kinds = (by_hand.COMMENT, by_hand.REQUEST, by_hand.ANSWER)
        return by_hand.of_attempts(*map(self.notes, kinds))

    def forget(self, student):
        """Delete a student's name and contents; return the deleted records."""
        deleted = self._write(lambda c: student_erasure.forget(c, student, self.who))
        return [gradebook_rows.stored_record(record) for record in deleted]


def _newest_of_each(bodies):
    found = {}
    for body in bodies:
        if "why" not in body:  # an older file that was submitted again is the newest attempt
            found.pop(body["key"], None)
        found[body["key"]] = body["record"]
    return found


def _attempt(record, why):
    body = gradebook_rows.stored(record) | ({"why": why} if why else {})
    return Entry("attempt", body, body["submission"])


def default_url(out, new=True):
    """Return the URL of a folder's gradebook. Raises GradebookError if the gradebook is missing and
    ``new`` is False.
    """
    file = out / "grades.db"
    if not new and not file.is_file():
        raise GradebookError(
            f"the gradebook {file} does not exist: grade submissions first, or give --db URL"
        )
    return f"sqlite:///{file}"
