"""Gradebook schema: the tables of attempts and of overrides (adjustments), and their rows."""

import hashlib
from dataclasses import asdict, replace
from datetime import UTC, datetime

import sqlalchemy as sa

from slamlab.exercises.verdict import LawResult, Verdict
from slamlab.grading.records import Record

TABLES = sa.MetaData()
ATTEMPTS = sa.Table(
    "attempts",
    TABLES,
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
    TABLES,
    sa.Column("id", sa.Integer, primary_key=True),
    sa.Column("submission", sa.Text, nullable=False, index=True),
    sa.Column("exercise", sa.String(8), nullable=False),
    sa.Column("task", sa.Text, nullable=False),
    sa.Column("points", sa.Float, nullable=False),
    sa.Column("reason", sa.Text, nullable=False),
    sa.Column("at", sa.String(32), nullable=False),
)


def attempt_row(record):
    """Serialise a record to its row in the table of attempts.

    Parameters
    ----------
    record : Record

    Returns
    -------
    dict, column to value
    """
    return {
        "key": attempt_key(record.submission, record.sha256, record.seed, record.reason),
        "submission": storable(record.submission),
        "student": storable(record.student),
        "exercise": record.exercise,
        "sha256": record.sha256,
        "score": record.score,
        "max_score": record.max_score,
        "isolation": record.isolation,
        "at": timestamp(),
        "record": storable(asdict(record)),
    }


def timestamp():
    """The current time (UTC) in ISO 8601."""
    return datetime.now(UTC).isoformat(timespec="seconds")


def attempt_key(submission, sha256, seed, reason=None):
    """The key (hash) that identifies an attempt: submission, content, seed of the inputs.

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


def identifying_columns(table):
    """The columns that identify a row when gradebooks are merged."""
    if table is ATTEMPTS:
        return [ATTEMPTS.c.key]
    return [column for column in ADJUSTMENTS.columns if column.name != "id"]


def storable(value):
    """Sanitise a value for every database: no lone surrogates, no zero characters in its text."""
    if isinstance(value, str):
        text = value.encode("utf-8", "backslashreplace").decode("utf-8")
        return text.replace("\0", "\\x00")
    if isinstance(value, dict):
        return {storable(str(name)): storable(item) for name, item in value.items()}
    if isinstance(value, list | tuple):
        return [storable(item) for item in value]
    return value


def stored_record(stored):
    """Deserialise the record that :func:`attempt_row` stored."""
    verdicts = tuple(
        Verdict(**(v | {"laws": tuple(LawResult(**law) for law in v["laws"])}))
        for v in stored["verdicts"]
    )
    cells = {int(cell): problem for cell, problem in stored["cells"].items()}
    found = Record(**(stored | {"verdicts": verdicts, "cells": cells}))
    return replace(found, notes=tuple(found.notes))
