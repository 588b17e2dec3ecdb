"""The gradebook: every attempt at grading a submission and every change by hand, in a database.

SQLite by default; any database that SQLAlchemy speaks to, by its URL. An attempt is written whole
in one transaction when it is known, under a key that is the same for the same content, so that a
grader that was killed loses what it was at, and one started again doubles nothing.
"""

import json

import sqlalchemy as sa

from slamlab.grading import rows
from slamlab.grading.rows import ADJUSTMENTS, ATTEMPTS, TABLES

NEWEST_LAST = ATTEMPTS.c.at, ATTEMPTS.c.id


class NoGradebook(Exception):
    """The database cannot be used; the text says why."""


class Gradebook:
    """Attempts and adjustments in a database.

    Parameters
    ----------
    url : str, such as sqlite:////home/me/grades.db or postgresql+psycopg://me@host/course

    Raises
    ------
    NoGradebook
    """

    def __init__(self, url):
        try:
            self._engine = sa.create_engine(url)
            TABLES.create_all(self._engine)
        except (sa.exc.SQLAlchemyError, ModuleNotFoundError) as error:
            said = str(error).strip().splitlines()[0][:300]
            raise NoGradebook(f"the gradebook cannot be opened: {said}") from None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        """Let go of the database; may be called twice."""
        self._engine.dispose()

    def add(self, record):
        """Write an attempt; one that is there already stays one, and becomes the newest.

        Parameters
        ----------
        record : Record

        Returns
        -------
        bool, whether it was new
        """
        row = rows.of(record)
        mine = ATTEMPTS.c.submission == row["submission"]
        known = sa.select(ATTEMPTS.c.key, ATTEMPTS.c.record).where(mine)
        with self._engine.begin() as connection:
            before = connection.execute(known.order_by(*NEWEST_LAST)).all()
            new = all(one.key != row["key"] for one in before)
            if not new:
                if before[-1] == (row["key"], json.loads(json.dumps(row["record"]))):
                    return False
                # an older version was handed in again, or at another time
                connection.execute(sa.delete(ATTEMPTS).where(ATTEMPTS.c.key == row["key"]))
            connection.execute(sa.insert(ATTEMPTS).values(row))
        return new

    def take(self, other):
        """Add what another gradebook holds.

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
                columns = rows.told_apart(table)
                known = {tuple(row) for row in connection.execute(sa.select(*columns))}
                for row in theirs:
                    if tuple(row[column.name] for column in columns) not in known:
                        new = {key: value for key, value in row.items() if key != "id"}
                        connection.execute(sa.insert(table).values(new))
                        added += table is ATTEMPTS
        return added

    def forget(self, submissions):
        """Drop the attempts at some submissions, so that they are graded again.

        Adjustments by hand stay.

        Parameters
        ----------
        submissions : list of str
        """
        with self._engine.begin() as connection:
            for name in submissions:
                here = ATTEMPTS.c.submission == rows.storable(name)
                connection.execute(sa.delete(ATTEMPTS).where(here))

    def known(self):
        """Every attempt.

        Returns
        -------
        dict, key to Record
        """
        with self._engine.connect() as connection:
            found = connection.execute(sa.select(ATTEMPTS.c.key, ATTEMPTS.c.record))
            return {row.key: rows.record(row.record) for row in found}

    def latest(self):
        """The newest attempt at each submission and exercise.

        Returns
        -------
        list of Record, sorted by submission
        """
        columns = ATTEMPTS.c.submission, ATTEMPTS.c.exercise, ATTEMPTS.c.record
        newest = {}
        with self._engine.connect() as connection:
            for row in connection.execute(sa.select(*columns).order_by(*NEWEST_LAST)):
                newest[row.submission] = rows.record(row.record)
        return [newest[name] for name in sorted(newest)]

    def adjust(self, submission, exercise, task, points, reason):
        """Set the points of a task by hand; the newest such change counts.

        Parameters
        ----------
        submission, exercise, task : str
        points : float
        reason : str
        """
        row = {
            "submission": rows.storable(submission),
            "exercise": exercise,
            "task": task,
            "points": float(points),
            "reason": rows.storable(reason),
            "at": rows.now(),
        }
        with self._engine.begin() as connection:
            connection.execute(sa.insert(ADJUSTMENTS).values(row))

    def adjustments(self):
        """What was set by hand.

        Returns
        -------
        dict, (submission, task) to (points, reason)
        """
        with self._engine.connect() as connection:
            found = connection.execute(
                sa.select(ADJUSTMENTS).order_by(ADJUSTMENTS.c.at, ADJUSTMENTS.c.id)
            )
            return {(row.submission, row.task): (row.points, row.reason) for row in found}


def url_of(out, new=True):
    """The URL of the gradebook in a folder of results.

    Parameters
    ----------
    out : Path
    new : bool, whether it may be made

    Returns
    -------
    str

    Raises
    ------
    NoGradebook : it is not there and must be
    """
    file = out / "grades.db"
    if not new and not file.is_file():
        raise NoGradebook(f"there is no gradebook {file}: grade first, or say --db URL")
    return f"sqlite:///{file}"
