"""Gradebook: every attempt (graded submission) and every manual override, in a ledger.

SQLite by default; any database that SQLAlchemy speaks to, by its URL. An attempt is appended whole
in one transaction when it is known, under a key that is the same for the same content, so that a
grader that was killed loses what it was at, and one started again doubles nothing. Nothing is ever
rewritten: of the rows of one key the last one holds.
"""

import json

from slamlab.grading import gradebook_rows, older_gradebooks
from slamlab.grading import remarks as by_hand
from slamlab.grading.database import GradebookError
from slamlab.grading.ledger import chain_merging, chains, contents, forgotten_students, sightings
from slamlab.grading.ledger.chains import Entry
from slamlab.grading.ledger.ledger_book import LedgerBook


class Gradebook(LedgerBook):
    """Attempts and manual overrides in an SQL database.

    Parameters
    ----------
    url, who : as of :class:`LedgerBook`

    Raises
    ------
    GradebookError : from here and every method, when the database cannot be used
    """

    def __init__(self, url, who=None):
        super().__init__(url, who)
        if self._read(older_gradebooks.is_older):
            self._write(lambda connection: older_gradebooks.adopt(connection, self.who))

    def add(self, record):
        """Store an attempt; one that is there already stays one, and becomes the newest.

        Parameters
        ----------
        record : Record

        Returns
        -------
        bool, whether it was new
        """
        return self.add_all([record]) == 1

    def add_all(self, records, why=None):
        """Store attempts as :meth:`add` does, all at once or none.

        Parameters
        ----------
        records : list of Record
        why : str or None, why those that are there are judged anew; they stay at their places then

        Returns
        -------
        int, how many were new
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
            contents.store(connection, kept)
            return new

        return self._write(added)

    def merge(self, other):
        """Merge another gradebook into this one: its ledger and its contents.

        Parameters
        ----------
        other : Gradebook

        Returns
        -------
        int, attempts that were new
        """
        theirs = other.rows()
        seen = other._read(sightings.listed)
        named = {name for record in other.attempts().values() for name in record.kept.values()}
        kept = other.contents(named)
        before = len(self.attempts())

        def merged(connection):
            chain_merging.merge(connection, theirs, self.who)
            contents.store(connection, kept)
            contents.drop_unnamed(connection)  # of whom was forgotten here
            sightings.merge(connection, seen)

        self._write(merged)
        return len(self.attempts()) - before

    def attempts(self):
        """All attempts.

        Returns
        -------
        dict, key to Record, the oldest first
        """
        found = self._read(lambda connection: chains.bodies(connection, "attempt"))
        return {
            key: gradebook_rows.stored_record(record)
            for key, record in _newest_of_each(found).items()
        }

    def latest_attempts(self):
        """The attempts that count: of each submission the latest in each exercise.

        What could not be graded counts while nothing was made of the submission later; of which
        exercise nobody knows, it takes the place of the one before.

        Returns
        -------
        list of Record, sorted by submission, of one the oldest first
        """
        newest = {}
        for record in reversed(self.attempts().values()):
            mine = newest.setdefault(record.submission, {})
            if [*mine] == [None]:
                mine[record.exercise] = mine.pop(None)
            elif record.graded or not mine:
                mine.setdefault(record.exercise, record)
        return [one for name in sorted(newest) for one in reversed(newest[name].values())]

    def override_points(self, submission, exercise, task, points, reason):
        """Add a manual override: the points of a task set by hand; the newest one counts.

        Parameters
        ----------
        submission, exercise, task : str
        points : float
        reason : str
        """
        body = {"exercise": exercise, "task": task, "points": float(points), "reason": reason}
        self.note("override", body, submission)

    def overrides(self):
        """The manual overrides, the newest of each task.

        Returns
        -------
        dict, (submission, task) to (points, reason)
        """
        found = self.notes("override")
        return {(one["submission"], one["task"]): (one["points"], one["reason"]) for one in found}

    def remarks(self):
        """What was written to students by hand.

        Returns
        -------
        dict, submission to tuple of str
        """
        return by_hand.of_submissions(*(self.notes(kind) for kind in by_hand.KINDS))

    def forget(self, student):
        """Delete name and content of a student for good; hashes stay.

        Parameters
        ----------
        student : str

        Returns
        -------
        list of Record, his attempts as they were
        """
        told = self._write(lambda c: forgotten_students.forget(c, student, self.who))
        return [gradebook_rows.stored_record(record) for record in told]


def _newest_of_each(bodies):
    """Attempt's key to what holds of it, in the order of attempts."""
    found = {}
    for body in bodies:
        if "why" not in body:  # an older version that was handed in again is the newest
            found.pop(body["key"], None)
        found[body["key"]] = body["record"]
    return found


def _attempt(record, why):
    body = gradebook_rows.stored(record) | ({"why": why} if why else {})
    return Entry("attempt", body, body["submission"])


def default_url(out, new=True):
    """The URL of the default gradebook (SQLite) in a folder of results.

    Parameters
    ----------
    out : Path
    new : bool, whether it may be made

    Returns
    -------
    str

    Raises
    ------
    GradebookError : it is not there and must be
    """
    file = out / "grades.db"
    if not new and not file.is_file():
        raise GradebookError(f"there is no gradebook {file}: grade first, or say --db URL")
    return f"sqlite:///{file}"
