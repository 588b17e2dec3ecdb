"""Batch grading: a folder's submissions, each stored when graded, so that it can resume."""

import contextlib
import re
import threading
from concurrent.futures import ThreadPoolExecutor, as_completed, wait
from dataclasses import replace
from hashlib import sha256
from pathlib import Path

from slamlab.grading import class_report, feedback, forked_workers, grade_tables, judge
from slamlab.grading.gradebook_rows import attempt_key
from slamlab.grading.marks import mark
from slamlab.grading.records import private_folder
from slamlab.grading.submissions import SubmissionError, read_bytes
from slamlab.grading.term.hand_ins import find_hand_ins


def prepare_grading(place: Path, out: Path, scratch: Path, secret=None, make=False):
    """Find the submissions, load the secret seed and make the folder of results.

    Parameters
    ----------
    place : Path, a folder or a zip of submissions
    out : Path, made where it is missing
    scratch : Path, an empty folder in which zips are unpacked
    secret : Path or None, the file of the secret; None: ``out/secret``, made where it is missing
    make : bool, whether the file of the secret is made where it is missing

    Returns
    -------
    (list of Submission, bytes)

    Raises
    ------
    SubmissionError : when one of them cannot be used
    """
    if out.resolve() == place.resolve():
        raise SubmissionError("the results need another folder than the submissions'")
    found = find_hand_ins(place, scratch, out)
    if not found:
        raise SubmissionError(f"there is no notebook in {place}")
    try:
        private_folder(out)
    except OSError as error:
        raise SubmissionError(f"{out} cannot be made: {error.strerror}") from None
    return found, judge.load_secret(secret or out / "secret", make=make or secret is None)


def select_shard(found, part):
    """Select one shard of the submissions, the same on every machine: for batch systems.

    Dealt out in the order of their names' hashes, shards differ by one submission at most; where
    there are more shards than submissions, some are empty.

    Parameters
    ----------
    found : list of Submission
    part : str, "i/n": the i-th of n parts

    Returns
    -------
    list of Submission

    Raises
    ------
    SubmissionError : not such a part
    """
    match = re.fullmatch(r"(\d+)/(\d+)", part)
    i, n = (int(number) for number in match.groups()) if match else (0, 0)
    if not 1 <= i <= n:
        raise SubmissionError(f"--shard is I/N such as 2/8, with I from 1 to N, not {part}")
    dealt = sorted(found, key=lambda s: (sha256(s.name.encode()).digest(), s.name))
    return sorted(dealt[i - 1 :: n], key=lambda s: s.name)


def grade_locally(found, secret, workers, default=None, known=None, jobs=1):
    """Grade submissions in parallel on this machine and yield records as they are done.

    Parameters
    ----------
    found : list of Submission
    secret : bytes
    workers : WorkerPool, closed in the end
    default : str or None, the exercise that all are to be of
    known : attempt's key to Record; these attempts are not graded again
    jobs : int, how many at once

    Yields
    ------
    Record
    """
    stop = threading.Event()
    with ThreadPoolExecutor(max(1, jobs)) as pool:
        futures = [
            pool.submit(judge.grade_submission, s, secret, workers, default, known, stop)
            for s in found
        ]
        try:
            yield from (future.result() for future in as_completed(futures))
        finally:
            stop.set()
            for future in futures:
                future.cancel()
            wait(futures)
            workers.close()  # before the threads end that they would die with


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
    with contextlib.closing(graded):  # nothing is graded any more when the gradebook is lost
        for record in graded:
            before = (kept or {}).get(record.submission)
            stored = policy.stored(record.student) if policy else before
            record = replace(record, policy=stored, seen=(seen or {}).get(record.submission))
            if not regrade:
                if not record.failed:
                    book.add(record)
                if term is None:
                    feedback.write_feedback_page(out, mark(record, overrides))
                record = replace(record, contents={})  # stored; a class's would fill the memory
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


def content_hashes(found):
    """What is handed in, by the order of names.

    Parameters
    ----------
    found : list of Submission

    Returns
    -------
    list of (name, hash of the file; empty where there is none that can be read)
    """
    listed = []
    for submission in sorted(found, key=lambda submission: submission.name):
        data = _content(submission)
        listed.append((submission.name, sha256(data).hexdigest() if data else ""))
    return listed


def named_modules(found):
    """Modules that submissions name, see :func:`forked_workers.named_modules`."""
    return forked_workers.named_modules(map(_content, found))


def _content(submission):
    """The bytes of a submission; none where there is nothing that can be read."""
    try:
        return read_bytes(submission)
    except SubmissionError:
        return b""


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
