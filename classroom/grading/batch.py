"""Batch grading: find the submissions of a folder, split them into shards, grade in parallel."""

import re
import threading
import time
from concurrent.futures import ThreadPoolExecutor, as_completed, wait
from dataclasses import replace
from datetime import datetime, timedelta
from hashlib import sha256
from pathlib import Path

from classroom.grading import forked_workers, judge
from classroom.grading.local_times import local_time
from classroom.grading.records import private_folder
from classroom.grading.submissions import SubmissionError, content_hash, in_order, read_bytes
from classroom.grading.term.lms_names import lms_name
from classroom.grading.term.zipped_submissions import collect_submissions

MAX_WAIT = 10.0  # after which further workers start, because the first may hang [s]
CLOCK_TOLERANCE = timedelta(minutes=5)
"""Largest difference between the clocks of two machines."""


def prepare_grading(source: Path, out: Path, scratch: Path, secret=None, make=False):
    """Return the submissions of a folder or zip file, and the secret. Zip files inside the folder
    or zip file are unpacked in ``scratch``. Raises SubmissionError.
    """
    if out.resolve() == source.resolve():
        raise SubmissionError("the results folder must not be the submissions folder")
    found = collect_submissions(source, scratch, out)
    if not found:
        raise SubmissionError(f"{source} contains no notebook")
    try:
        private_folder(out)
    except OSError as error:
        raise SubmissionError(f"the folder {out} cannot be created: {error.strerror}") from None
    return found, judge.load_secret(secret or out / "secret", make=make or secret is None)


def select_shard(found, part):
    """Return the i-th of n shards of the submissions ("i/n"). Names are sorted by hash, so that
    every machine computes the same shards.
    """
    match = re.fullmatch(r"(\d+)/(\d+)", part)
    i, n = (int(number) for number in match.groups()) if match else (0, 0)
    if not 1 <= i <= n:
        raise SubmissionError(f"--shard must be I/N such as 2/8, with I from 1 to N, not {part}")
    hashed = sorted(found, key=lambda s: (sha256(s.name.encode()).digest(), s.name))
    return in_order(hashed[i - 1 :: n])


def grade_locally(found, judges, known=None):
    """Yield each record as soon as it is graded; close ``judges`` at the end."""
    start, of_each = StaggeredStart(len(found)), attempts_by_submission(known)
    with ThreadPoolExecutor(max(1, judges.count), initializer=start) as pool:
        futures = [pool.submit(judges.grade, s, of_each.get(s.name)) for s in found]
        for future in futures:
            future.add_done_callback(start.done)
        try:
            yield from (future.result() for future in as_completed(futures))
        finally:
            for future in futures:
                future.cancel()
            judges.stop()
            start.release()
            wait(futures)
            judges.close()  # before the threads end, because their workers end with them


class StaggeredStart:
    """Thread-pool initializer that delays all threads except the first. The other threads start
    when grading the rest of ``count`` submissions would take longer than starting a worker, or
    after ``max_wait`` [s].
    """

    def __init__(self, count, clock=time.monotonic, max_wait=MAX_WAIT):
        self._count, self._clock, self._patience = count, clock, max_wait
        self._begun, self._start, self._done = clock(), 0.0, 0
        self._lock, self._first, self._pays = threading.Lock(), True, threading.Event()

    def __call__(self):
        """Wait until one more worker would save time; the first thread never waits."""
        with self._lock:
            first, self._first = self._first, False
        if not first:
            self._pays.wait(self._patience)

    def done(self, _=None):
        with self._lock:
            self._done, took = self._done + 1, self._clock() - self._begun
            if self._done == 1:
                self._start = took
            left, others = self._count - self._done, self._done - 1
            pays = left * (took - self._start) > others * self._start
        if left <= 0 or pays:
            self.release()

    def release(self):
        self._pays.set()


def attempts_by_submission(known):
    found = {}
    for key, record in (known or {}).items():
        found.setdefault(record.submission, {})[key] = record
    return found


def content_hashes(found):
    """Return pairs (name, hash) of files, sorted by name; the hash of an unreadable file is ""."""
    return [(each.name, content_hash(each.path) or "") for each in in_order(found)]


def with_decisions(found, listed, taken, exercise=None):
    """Return submissions with their hashes. Those that a grader took (``taken``, the bodies of the
    ledger's rows) for ``exercise`` belong to the student and exercise that the grader named.
    """
    contents, made = dict(listed), []
    decided = {(body["submission"], body["sha256"]): body for body in taken}
    for each in found:
        each = replace(each, sha256=contents.get(each.name) or None)
        body = decided.get((each.name, each.sha256))
        if body and exercise in (None, body["exercise"]):
            who = {"student": body["student"], "taken_as": body["exercise"]}
            each = replace(each, problem=None, **who)
        made.append(each)
    return made


def clamp_future_times(found, listed, attempts, now, zone=None):
    """Replace submission times in the future with the time when the file was first read. A student
    can change a file's time, but not a time recorded by an LMS or nbgrader. The time of the first
    reading is kept, so that a regrade makes no submission late. ``attempts`` are sorted, oldest
    first.
    """
    contents, first = dict(listed), {}
    for record in attempts:
        first.setdefault((record.submission, record.sha256), record.handed_in)
    made = []
    for each in found:
        by_others = each.has_trusted_time or (each.when is not None and lms_name(each.name))
        stated = None if by_others else each.handed_in
        if stated and datetime.fromisoformat(stated) > now + CLOCK_TOLERANCE:
            when = first.get((each.name, contents.get(each.name)))
            if not when or datetime.fromisoformat(when) > now:
                when = now.isoformat()
            stated = local_time(stated, zone, named=True)
            note = f"the file's time {stated} is in the future; the time of reading counts"
            each = replace(each, when=when, note=note)
        made.append(each)
    return made


def modules_to_preload(found):
    """See :func:`forked_workers.modules_to_preload`."""
    return forked_workers.modules_to_preload(map(_content, found))


def _content(submission):
    try:
        return read_bytes(submission)
    except SubmissionError:
        return b""
