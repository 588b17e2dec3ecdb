"""Rows of a gradebook: convert records to plain values and back; compute an attempt's key."""

import hashlib
from dataclasses import fields, is_dataclass, replace
from datetime import UTC, datetime

from classroom.exercises.verdict import LawResult, Verdict
from classroom.grading.records import Record

NOT_STORED = ("contents",)
_FIELDS = frozenset(field.name for field in fields(Record))


def stored(record):
    """Return a record as plain values, without its contents, and its key."""
    plain = storable({n: value for n, value in vars(record).items() if n not in NOT_STORED})
    key = attempt_key(record.submission, record.sha256, record.seed, record.reason)
    return {"key": key, "submission": plain["submission"], "record": plain}


def timestamp():
    """Return the current time (UTC, ISO 8601)."""
    return datetime.now(UTC).isoformat(timespec="seconds")


def attempt_key(submission, sha256, seed, reason=None):
    """Return the hash of a submission's name, content and seed, or of the reason why these are
    missing.
    """
    parts = submission, sha256 or "", seed or "", "" if sha256 and seed else reason or ""
    text = "\0".join(parts)
    return hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()


def storable(value):
    """Return plain values without lone surrogates and NUL characters, for any database."""
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
    verdicts = tuple(
        Verdict(
            **v
            | {"laws": tuple(LawResult(**law) for law in v["laws"])}
            | {"replaced": tuple(v.get("replaced", ()))}
        )
        for v in stored["verdicts"]
    )
    cells = dict(sorted((int(cell), problem) for cell, problem in stored["cells"].items()))
    # fields of older versions are ignored
    known = {name: value for name, value in stored.items() if name in _FIELDS}
    found = Record(**(known | {"verdicts": verdicts, "cells": cells}))
    return replace(found, notes=tuple(found.notes), signs=tuple(found.signs))
