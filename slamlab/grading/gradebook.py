"""Gradebook: every attempt (graded submission) and every manual override, in a database.

SQLite by default; any database that SQLAlchemy speaks to, by its URL. An attempt is written whole
in one transaction when it is known, under a key that is the same for the same content, so that a
grader that was killed loses what it was at, and one started again doubles nothing. Which attempt
is the newest is told by a counter, the row's number; a clock may be wrong.
"""

import json
from itertools import accumulate

import sqlalchemy as sa

from slamlab.grading import gradebook_rows
from slamlab.grading.database import Database, GradebookError
from slamlab.grading.gradebook_rows import ADJUSTMENTS, ATTEMPTS


class Gradebook:
    """Attempts and manual overrides in an SQL database.

    Parameters
    ----------
    url : str, such as sqlite:////home/me/grades.db or postgresql+psycopg://me@host/course

    Raises
    ------
    GradebookError : from here and every method, when the database cannot be used
    """

    def __init__(self, url):
        self._database = Database(url, gradebook_rows.TABLES)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        """Close the connections to the database; may be called twice."""
        self._database.close()

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

    def add_all(self, records):
        """Store attempts as :meth:`add` does, all at once or none.

        Parameters
        ----------
        records : list of Record

        Returns
        -------
        int, how many were new
        """
        rows = [gradebook_rows.attempt_row(record) for record in records]
        return self._database.transact(lambda connection: sum(_add(connection, r) for r in rows))

    def merge(self, other):
        """Merge another gradebook into this one: its attempts and its overrides.

        Parameters
        ----------
        other : Gradebook

        Returns
        -------
        int, attempts that were new
        """
        theirs = {table: other._rows(table) for table in (ATTEMPTS, ADJUSTMENTS)}

        def merged(connection):
            _merge(connection, ADJUSTMENTS, theirs[ADJUSTMENTS])
            return _merge(connection, ATTEMPTS, theirs[ATTEMPTS])

        return self._database.transact(merged)

    def _rows(self, table):
        return self._database.transact(lambda connection: _rows(connection, table))

    def attempts(self):
        """All attempts.

        Returns
        -------
        dict, key to Record, the oldest first
        """
        found = self._rows(ATTEMPTS)
        return {row["key"]: gradebook_rows.stored_record(row["record"]) for row in found}

    def latest_attempts(self):
        """The attempt that counts: the latest of each submission.

        Returns
        -------
        list of Record, sorted by submission
        """
        newest = {row["submission"]: row["record"] for row in self._rows(ATTEMPTS)}
        return [gradebook_rows.stored_record(newest[name]) for name in sorted(newest)]

    def override_points(self, submission, exercise, task, points, reason):
        """Add a manual override: the points of a task set by hand; the newest one counts.

        Parameters
        ----------
        submission, exercise, task : str
        points : float
        reason : str
        """
        row = {
            "submission": gradebook_rows.storable(submission),
            "exercise": exercise,
            "task": task,
            "points": float(points),
            "reason": gradebook_rows.storable(reason),
            "at": gradebook_rows.timestamp(),
        }

        def written(connection):  # once, though it be tried twice
            connection.execute(sa.delete(ADJUSTMENTS).filter_by(**row))
            connection.execute(sa.insert(ADJUSTMENTS).values(row))

        self._database.transact(written)

    def overrides(self):
        """The manual overrides, the newest of each task.

        Returns
        -------
        dict, (submission, task) to (points, reason)
        """
        found = self._rows(ADJUSTMENTS)
        return {(row["submission"], row["task"]): (row["points"], row["reason"]) for row in found}


def _rows(connection, table):
    """All rows of a table as dicts, the oldest first."""
    found = connection.execute(sa.select(table).order_by(table.c.id))
    return [dict(row) for row in found.mappings()]


def _add(connection, row):
    """Insert the row of an attempt as its submission's newest; whether it was new."""
    mine = ATTEMPTS.c.submission == row["submission"]
    known = sa.select(ATTEMPTS.c.key, ATTEMPTS.c.record).where(mine).order_by(ATTEMPTS.c.id)
    before = connection.execute(known).all()
    new = all(one.key != row["key"] for one in before)
    if not new:
        if before[-1] == (row["key"], json.loads(json.dumps(row["record"]))):
            return False
        # an older version was handed in again, or at another time
        connection.execute(sa.delete(ATTEMPTS).where(ATTEMPTS.c.key == row["key"]))
    connection.execute(sa.insert(ATTEMPTS).values(row))
    return new


def _merge(connection, table, theirs):
    """Merge another gradebook's rows into a table; how many were new."""
    added, ours = 0, _histories(_rows(connection, table), table)
    for whose, other in _histories(theirs, table).items():
        mine = ours.get(whose, [])
        both = _one_order(mine, other, gradebook_rows.identifying_columns(table))
        added += len(both) - len(mine)
        if both != mine:
            connection.execute(sa.delete(table).where(table.c.id.in_(row["id"] for row in mine)))
            new = [{name: row[name] for name in row if name != "id"} for row in both]
            connection.execute(sa.insert(table), new)
    return added


def _histories(rows, table):
    """Rows by what they are of: a submission, or a task of one."""
    found, columns = {}, ("submission",) if table is ATTEMPTS else ("submission", "task")
    for row in rows:
        found.setdefault(tuple(row[name] for name in columns), []).append(row)
    return found


def _one_order(ours, theirs, columns):
    """Rows of two gradebooks in one order, each once, the newer of two that are the same.

    Each gradebook's own order stays; only between the two it is the clock that tells.
    """
    timed = []
    for rows in (theirs, ours):  # at the same time ours is the newer
        timed += zip(accumulate((row["at"] for row in rows), max), rows, strict=True)
    found = {}
    for _, row in sorted(timed, key=lambda pair: pair[0]):
        key = tuple(row[column.name] for column in columns)
        found.pop(key, None)
        found[key] = row
    return list(found.values())


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
