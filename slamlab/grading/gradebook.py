"""The gradebook: every attempt at grading a submission and every change by hand, in a database.

SQLite by default; any database that SQLAlchemy speaks to, by its URL. An attempt is written whole
in one transaction when it is known, under a key that is the same for the same content, so that a
grader that was killed loses what it was at, and one started again doubles nothing.
"""

import hashlib
import json
from dataclasses import asdict, replace
from datetime import UTC, datetime

import sqlalchemy as sa

from slamlab.checks.verdict import LawResult, Verdict
from slamlab.grading.records import Record

_TABLES = sa.MetaData()
ATTEMPTS = sa.Table(
    "attempts",
    _TABLES,
    sa.Column("id", sa.Integer, primary_key=True),
    sa.Column("key", sa.String(64), unique=True, nullable=False),
    sa.Column("submission", sa.Text, nullable=False, index=True),
    sa.Column("student", sa.Text, nullable=False),
    sa.Column("exercise", sa.String(8)),
    sa.Column("sha256", sa.String(64)),
    sa.Column("score", sa.Float),
    sa.Column("max_score", sa.Float),
    sa.Column("isolation", sa.String(8)),
    sa.Column("at", sa.String(32), nullable=False),
    sa.Column("record", sa.JSON, nullable=False),
)
ADJUSTMENTS = sa.Table(
    "adjustments",
    _TABLES,
    sa.Column("id", sa.Integer, primary_key=True),
    sa.Column("submission", sa.Text, nullable=False, index=True),
    sa.Column("exercise", sa.String(8), nullable=False),
    sa.Column("task", sa.Text, nullable=False),
    sa.Column("points", sa.Float, nullable=False),
    sa.Column("reason", sa.Text, nullable=False),
    sa.Column("at", sa.String(32), nullable=False),
)


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
            _TABLES.create_all(self._engine)
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
        row = {
            "key": key(record.submission, record.sha256, record.seed, record.reason),
            "submission": _storable(record.submission),
            "student": _storable(record.student),
            "exercise": record.exercise,
            "sha256": record.sha256,
            "score": record.score,
            "max_score": record.max_score,
            "isolation": record.isolation,
            "at": datetime.now(UTC).isoformat(timespec="seconds"),
            "record": _storable(asdict(record)),
        }
        mine = ATTEMPTS.c.submission == row["submission"]
        rows = sa.select(ATTEMPTS.c.key, ATTEMPTS.c.record).where(mine).order_by(ATTEMPTS.c.id)
        with self._engine.begin() as connection:
            before = connection.execute(rows).all()
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
                rows = connection.execute(sa.select(table).order_by(table.c.id)).mappings().all()
            with self._engine.begin() as connection:
                known = {tuple(row) for row in connection.execute(sa.select(*_told_apart(table)))}
                for row in rows:
                    if tuple(row[column.name] for column in _told_apart(table)) not in known:
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
                here = ATTEMPTS.c.submission == _storable(name)
                connection.execute(sa.delete(ATTEMPTS).where(here))

    def known(self):
        """Every attempt.

        Returns
        -------
        dict, key to Record
        """
        with self._engine.connect() as connection:
            rows = connection.execute(sa.select(ATTEMPTS.c.key, ATTEMPTS.c.record))
            return {row.key: _record(row.record) for row in rows}

    def latest(self):
        """The newest attempt at each submission and exercise.

        Returns
        -------
        list of Record, sorted by submission
        """
        columns = ATTEMPTS.c.submission, ATTEMPTS.c.exercise, ATTEMPTS.c.record
        newest = {}
        with self._engine.connect() as connection:
            for row in connection.execute(sa.select(*columns).order_by(ATTEMPTS.c.id)):
                newest[row.submission] = _record(row.record)
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
            "submission": _storable(submission),
            "exercise": exercise,
            "task": task,
            "points": float(points),
            "reason": _storable(reason),
            "at": datetime.now(UTC).isoformat(timespec="seconds"),
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
            rows = connection.execute(sa.select(ADJUSTMENTS).order_by(ADJUSTMENTS.c.id))
            return {(row.submission, row.task): (row.points, row.reason) for row in rows}


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


def _told_apart(table):
    """The columns that tell one row from another, whichever database it stands in."""
    if table is ATTEMPTS:
        return [ATTEMPTS.c.key]
    return [column for column in ADJUSTMENTS.columns if column.name != "id"]


def key(submission, sha256, seed, reason=None):
    """What an attempt is told apart by: whose, which content, which inputs.

    What had no content to grade is told apart by the reason.

    Parameters
    ----------
    submission : str
    sha256, seed : str or None
    reason : str or None

    Returns
    -------
    str, 64 hexadecimal digits
    """
    parts = submission, sha256 or "", seed or "", "" if sha256 and seed else reason or ""
    text = "\0".join(parts)
    return hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()


def _storable(value):
    """A value that every database takes: no half characters, no zero characters in its text."""
    if isinstance(value, str):
        text = value.encode("utf-8", "backslashreplace").decode("utf-8")
        return text.replace("\0", "\\x00")
    if isinstance(value, dict):
        return {_storable(str(name)): _storable(item) for name, item in value.items()}
    if isinstance(value, list | tuple):
        return [_storable(item) for item in value]
    return value


def _record(stored):
    verdicts = tuple(
        Verdict(**(v | {"laws": tuple(LawResult(**law) for law in v["laws"])}))
        for v in stored["verdicts"]
    )
    cells = {int(cell): problem for cell, problem in stored["cells"].items()}
    record = Record(**(stored | {"verdicts": verdicts, "cells": cells}))
    return replace(record, notes=tuple(record.notes))
