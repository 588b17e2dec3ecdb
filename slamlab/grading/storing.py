"""Storing what was graded: each record when it is made, so that a class can be gone on with."""

import contextlib
import math
import time
from dataclasses import replace

from slamlab.grading import class_report, feedback, grade_tables
from slamlab.grading.gradebook_rows import attempt_key
from slamlab.grading.marks import mark

MOMENT, MOST_TOGETHER = 0.5, 50
"""Results that come within a moment [s] are stored in one transaction, so many of them at most."""


def store_records(
    graded, out, book, default=None, policy=None, regrade=False, kept=None, term=None, seen=None
):
    """Store each record in the gradebook with its feedback page, and all tables at the end.

    A regrade's records take the place of the older ones all at once, when the last is known.

    Parameters
    ----------
    graded : iterable of Record
    out : Path
    book : Gradebook
    default : str or None, an exercise whose columns stand in the table in any case
    policy : LatePolicy or None; None: the one that was kept
    regrade : bool
    kept : submission to the policy stored with it before, see :func:`kept_policies`
    term : Term or None, which writes its own tables and pages
    seen : submission to the number under which it was seen; None for none

    Yields
    ------
    Record, written; those of a regrade are not yet
    """
    records, overrides = [], book.overrides()

    def finished(record):
        before = (kept or {}).get(record.submission)
        stored = policy.stored(record.student) if policy else before
        return replace(record, policy=stored, seen=(seen or {}).get(record.submission))

    def store(some):
        book.add_all([record for record in some if not record.failed])
        for record in some if term is None else ():
            feedback.write_feedback_page(out, mark(record, overrides))
        return [replace(record, contents={}) for record in some]  # they would fill the memory

    with contextlib.closing(graded):  # nothing is graded any more when the gradebook is lost
        results = map(finished, graded)
        for record in results if regrade else _stored_together(results, store):
            records.append(record)
            yield record
    if regrade:
        records, overrides = _swap(records, book), book.overrides()
    if term is not None:
        term.write(book, {record.exercise for record in records})
        return
    marks = [mark(record, overrides) for record in records]
    for each in marks if regrade else ():
        feedback.write_feedback_page(out, each)
    write_results(out, marks, default)


def _stored_together(results, store):
    """Records as they are once stored; those that come within a moment are stored at once."""
    waiting, since = [], -math.inf
    try:
        for record in results:
            waiting.append(record)
            if len(waiting) >= MOST_TOGETHER or time.monotonic() - since >= MOMENT:
                some, waiting = waiting, []
                yield from store(some)
                since = time.monotonic()
    finally:  # also when it is broken off
        left = store(waiting) if waiting else []
    yield from left


def kept_policies(book):
    """The late policy that was stored with each submission, so that grading again keeps it."""
    return {record.submission: record.policy for record in book.latest_attempts()}


def _swap(records, book):
    """Put records in the place of older ones at once; where the grader failed, the older stays."""
    older = book.attempts()
    book.add_all([record for record in records if not record.failed])
    keys = [attempt_key(record.submission, record.sha256, record.seed) for record in records]
    return [
        older.get(key, record) if record.failed else record
        for key, record in zip(keys, records, strict=True)
    ]


def write_results(out, marks, default=None):
    """Write the tables of grades and the class report.

    Parameters
    ----------
    out : Path
    marks : list of Mark
    default : str or None, an exercise whose columns stand in the table in any case
    """
    grade_tables.write_tables(out, marks, default)
    class_report.write_report(out, marks)
