"""Records as a gradebook stores them: plain values, the key of an attempt, and back."""

import hashlib
from dataclasses import fields, is_dataclass, replace
from datetime import UTC, datetime

import sqlalchemy as sa

from slamlab.exercises.verdict import LawResult, Verdict
from slamlab.grading.records import Record

TABLES = sa.MetaData()
"""All tables of a gradebook; those of the ledger are told by :mod:`slamlab.grading.ledger`."""
NOT_STORED = ("contents",)
_FIELDS = frozenset(field.name for field in fields(Record))


def stored(record):
    """A record as plain values, without what is kept of it elsewhere, and its key.

    Parameters
    ----------
    record : Record

    Returns
    -------
    dict
    """
    plain = storable({n: value for n, value in vars(record).items() if n not in NOT_STORED})
    key = attempt_key(record.submission, record.sha256, record.seed, record.reason)
    return {"key": key, "submission": plain["submission"], "record": plain}


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


def storable(value):
    """Plain values for every database: no lone surrogates, no zero characters in their text."""
    if isinstance(value, str):
        if value.isascii() and "\0" not in value:
            return value
        text = value.encode("utf-8", "backslashreplace").decode("utf-8")
        return text.replace("\0", "\\x00")
    if isinstance(value, dict):
        return {storable(str(name)): storable(item) for name, item in value.items()}
    if isinstance(value, list | tuple):
        return [storable(item) for item in value]
    if value is None or isinstance(value, int | float):
        return value
    return storable(vars(value)) if is_dataclass(value) else value


def stored_record(stored):
    """The record that :func:`stored` made plain."""
    verdicts = tuple(
        Verdict(**(v | {"laws": tuple(LawResult(**law) for law in v["laws"])}))
        for v in stored["verdicts"]
    )
    cells = {int(cell): problem for cell, problem in stored["cells"].items()}
    # what an older version stored besides is passed over
    told = {name: value for name, value in stored.items() if name in _FIELDS}
    found = Record(**(told | {"verdicts": verdicts, "cells": cells}))
    return replace(found, notes=tuple(found.notes), signs=tuple(found.signs))
