"""Store each record as soon as it is graded, so that an interrupted run can continue."""

import contextlib
import math
import time
from dataclasses import replace

from classroom.grading import class_report, feedback, grade_tables
from classroom.grading.gradebook_rows import attempt_key
from classroom.grading.marks import mark
from classroom.grading.term.exercise_results import decision, undecided

BATCH_SECONDS, MAX_BATCH_SIZE = 0.5, 50
"""Up to MAX_BATCH_SIZE results within BATCH_SECONDS [s] are stored in one transaction."""


def store_records(
    graded, out, book, default=None, policy=None, regrade=False, kept=None, term=None, seen=None
):
    """Store each record with its feedback page and yield it; write all tables at the end. The
    records of a regrade replace older ones in one transaction. Without a ``policy``, those in
    ``kept`` apply.
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
        return [replace(record, contents={}) for record in some]  # to save memory

    with contextlib.closing(graded):  # grading stops when the gradebook is lost
        results = map(finished, graded)
        for record in results if regrade else _store_in_batches(results, store):
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


def _store_in_batches(results, store):
    """Store and yield results in batches."""
    waiting, since = [], -math.inf
    try:
        for record in results:
            waiting.append(record)
            if len(waiting) >= MAX_BATCH_SIZE or time.monotonic() - since >= BATCH_SECONDS:
                some, waiting = waiting, []
                yield from store(some)
                since = time.monotonic()
    finally:  # also when grading is interrupted
        left = store(waiting) if waiting else []
    yield from left


def stored_policies(book):
    """Return the stored late policy of each submission; a regrade does not change it."""
    return {record.submission: record.policy for record in book.latest_attempts()}


def undecided_lines(book, records):
    """Return a line for each task set by hand on an earlier content of a submission."""
    lines, overrides, found = [], book.overrides(), list(book.attempts().values())
    for record in records:
        before = [mark(one, overrides) for one in found if one.submission == record.submission
                  and one.exercise == record.exercise and one.sha256 != record.sha256]  # fmt: skip
        clauses = undecided(mark(record, overrides), before)
        lines += [decision(record.submission, *clause) for clause in clauses.items()]
    return lines


def _swap(records, book):
    """Replace older records, except those of submissions for which the grader failed."""
    older = book.attempts()
    book.add_all([record for record in records if not record.failed])
    keys = [attempt_key(record.submission, record.sha256, record.seed) for record in records]
    return [
        older.get(key, record) if record.failed else record
        for key, record in zip(keys, records, strict=True)
    ]


def write_results(out, marks, default=None):
    grade_tables.write_tables(out, marks, default)
    class_report.write_report(out, marks)
