"""Gradebook: every attempt (graded submission) and every manual override, in a database.

SQLite by default; any database that SQLAlchemy speaks to, by its URL. An attempt is written whole
in one transaction when it is known, under a key that is the same for the same content, so that a
grader that was killed loses what it was at, and one started again doubles nothing.
"""

import json

import sqlalchemy as sa

from slamlab.grading import gradebook_rows
from slamlab.grading.gradebook_rows import ADJUSTMENTS, ATTEMPTS, TABLES

# sort order of attempts
OLDEST_FIRST = ATTEMPTS.c.at, ATTEMPTS.c.id


class GradebookError(Exception):
    """The gradebook's database cannot be used; the text says why."""


class Gradebook:
    """Attempts and manual overrides in an SQL database.

    Parameters
    ----------
    url : str, such as sqlite:////home/me/grades.db or postgresql+psycopg://me@host/course

    Raises
    ------
    GradebookError
    """

    def __init__(self, url):
        try:
            self._engine = sa.create_engine(url)
            TABLES.create_all(self._engine)
        except (sa.exc.SQLAlchemyError, ModuleNotFoundError) as error:
            said = str(error).strip().splitlines()[0][:300]
            raise GradebookError(f"the gradebook cannot be opened: {said}") from None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        """Close the connections to the database; may be called twice."""
        self._engine.dispose()

    def add(self, record):
        """Store an attempt; one that is there already stays one, and becomes the newest.

        Parameters
        ----------
        record : Record

        Returns
        -------
        bool, whether it was new
        """
        row = gradebook_rows.attempt_row(record)
        mine = ATTEMPTS.c.submission == row["submission"]
        known = sa.select(ATTEMPTS.c.key, ATTEMPTS.c.record).where(mine)
        with self._engine.begin() as connection:
            before = connection.execute(known.order_by(*OLDEST_FIRST)).all()
            new = all(one.key != row["key"] for one in before)
            if not new:
                if before[-1] == (row["key"], json.loads(json.dumps(row["record"]))):
                    return False
                # an older version was handed in again, or at another time
                connection.execute(sa.delete(ATTEMPTS).where(ATTEMPTS.c.key == row["key"]))
            connection.execute(sa.insert(ATTEMPTS).values(row))
        return new

    def merge(self, other):
        """Merge another gradebook into this one: its attempts and its overrides.

        Parameters
        ----------
        other : Gradebook

        Returns
        -------
        int, attempts that were new
        """
        added = 0
        for table in (ATTEMPTS, ADJUSTMENTS):
            with other._engine.connect() as connection:
                theirs = connection.execute(sa.select(table).order_by(table.c.id)).mappings().all()
            with self._engine.begin() as connection:
                columns = gradebook_rows.identifying_columns(table)
                known = {tuple(row) for row in connection.execute(sa.select(*columns))}
                for row in theirs:
                    if tuple(row[column.name] for column in columns) not in known:
                        new = {key: value for key, value in row.items() if key != "id"}
                        connection.execute(sa.insert(table).values(new))
                        added += table is ATTEMPTS
        return added

    def delete_attempts(self, submissions):
        """Delete the attempts of some submissions for a regrade.

        Manual overrides stay.

        Parameters
        ----------
        submissions : list of str
        """
        with self._engine.begin() as connection:
            for name in submissions:
                here = ATTEMPTS.c.submission == gradebook_rows.storable(name)
                connection.execute(sa.delete(ATTEMPTS).where(here))

    def attempts(self):
        """All attempts.

        Returns
        -------
        dict, key to Record, the oldest first
        """
        columns = sa.select(ATTEMPTS.c.key, ATTEMPTS.c.record)
        with self._engine.connect() as connection:
            found = connection.execute(columns.order_by(*OLDEST_FIRST))
            return {row.key: gradebook_rows.stored_record(row.record) for row in found}

    def latest_attempts(self):
        """The attempt that counts: the latest of each submission.

        Returns
        -------
        list of Record, sorted by submission
        """
        columns = ATTEMPTS.c.submission, ATTEMPTS.c.exercise, ATTEMPTS.c.record
        newest = {}
        with self._engine.connect() as connection:
            for row in connection.execute(sa.select(*columns).order_by(*OLDEST_FIRST)):
                newest[row.submission] = gradebook_rows.stored_record(row.record)
        return [newest[name] for name in sorted(newest)]

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
        with self._engine.begin() as connection:
            connection.execute(sa.insert(ADJUSTMENTS).values(row))

    def overrides(self):
        """The manual overrides, the newest of each task.

        Returns
        -------
        dict, (submission, task) to (points, reason)
        """
        with self._engine.connect() as connection:
            found = connection.execute(
                sa.select(ADJUSTMENTS).order_by(ADJUSTMENTS.c.at, ADJUSTMENTS.c.id)
            )
            return {(row.submission, row.task): (row.points, row.reason) for row in found}


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
