"""Grading all submissions of a folder, each written down when it is known."""

import re
import threading
from concurrent.futures import ThreadPoolExecutor, as_completed, wait
from hashlib import sha256
from pathlib import Path

from slamlab.grading import classreport, feedback, judge, late, submissions, tables
from slamlab.grading.marks import mark
from slamlab.grading.submissions import Unreadable


def prepare(folder: Path, out: Path, secret: Path | None = None):
    """Find the submissions, the secret and the place for what becomes known.

    Parameters
    ----------
    folder : Path, of submissions
    out : Path, made where it is missing
    secret : Path or None, the file of the secret; None: ``out/secret``, made where it is missing

    Returns
    -------
    (list of Submission, bytes)

    Raises
    ------
    Unreadable : when one of them cannot be used
    """
    if out.resolve() == folder.resolve():
        raise Unreadable("the results need another folder than the submissions'")
    found = submissions.find(folder, out)
    if not found:
        raise Unreadable(f"there is no notebook in {folder}")
    try:
        out.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise Unreadable(f"{out} cannot be made: {error.strerror}") from None
    return found, judge.secret_from(secret or out / "secret", make=secret is None)


def shard(found, part):
    """One part of the submissions, the same whoever asks: for batch systems.

    Parameters
    ----------
    found : list of Submission
    part : str, "i/n": the i-th of n parts

    Returns
    -------
    list of Submission

    Raises
    ------
    Unreadable : not such a part
    """
    match = re.fullmatch(r"(\d+)/(\d+)", part)
    i, n = (int(number) for number in match.groups()) if match else (0, 0)
    if not 1 <= i <= n:
        raise Unreadable(f"--shard is I/N such as 2/8, with I from 1 to N, not {part}")
    mine = [s for s in found if int(sha256(s.name.encode()).hexdigest(), 16) % n == i - 1]
    if not mine:
        raise Unreadable(f"part {part} of {len(found)} submissions is empty")
    return mine


def grade_here(found, secret, workers, default=None, known=None, jobs=1):
    """Grade submissions side by side on this machine, records as they are done.

    Parameters
    ----------
    found : list of Submission
    secret : bytes
    workers : Workers, closed in the end
    default : str or None, the exercise of notebooks that do not tell it
    known : attempt's key to Record, which are not graded again
    jobs : int, how many at once

    Yields
    ------
    Record
    """
    stop = threading.Event()
    with ThreadPoolExecutor(jobs) as pool:
        futures = [
            pool.submit(judge.grade, s, secret, workers, default, known, stop) for s in found
        ]
        try:
            yield from (future.result() for future in as_completed(futures))
        finally:
            stop.set()
            for future in futures:
                future.cancel()
            wait(futures)
            workers.close()  # before the threads end that they would die with


def write_down(graded, out, book, default=None, policy=late.NONE):
    """Write records as they come, and all results when no more come.

    Parameters
    ----------
    graded : iterable of Record
    out : Path
    book : Gradebook
    default : str or None, an exercise whose columns stand in the table in any case
    policy : Policy, what lateness costs

    Yields
    ------
    Record, written
    """
    done, by_hand = [], book.adjustments()
    try:
        for record in graded:
            done.append(mark(record, by_hand, policy))
            if not record.failed:
                book.add(record)
            feedback.write_page(out, done[-1])
            yield record
    finally:
        write_results(out, done, default)


def write_results(out, marks, default=None):
    """Write the tables of grades and the page on the class.

    Parameters
    ----------
    out : Path
    marks : list of Mark
    default : str or None, an exercise whose columns stand in the table in any case
    """
    tables.write_tables(out, marks, default)
    classreport.write_report(out, marks)
