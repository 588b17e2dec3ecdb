"""Grading all submissions of a folder, each written down when it is known."""

import threading
from concurrent.futures import ThreadPoolExecutor, as_completed
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


def grade_all(found, secret, out, book, workers, default=None, jobs=1, policy=late.NONE):
    """Grade submissions side by side; records come as they are done, already written.

    What the gradebook knows is not graded again.

    Parameters
    ----------
    found : list of Submission
    secret : bytes
    out : Path
    book : Gradebook
    workers : Workers
    default : str or None, the exercise of notebooks that do not tell it
    jobs : int, how many at once
    policy : Policy, what lateness costs

    Yields
    ------
    Record
    """
    done, stop, known = [], threading.Event(), book.known()
    pool = ThreadPoolExecutor(jobs)
    try:
        futures = [
            pool.submit(judge.grade, s, secret, workers, default, known, stop) for s in found
        ]
        for future in as_completed(futures):
            record = future.result()
            done.append(record)
            if not record.failed:
                book.add(record)
            feedback.write_page(out, record)
            yield record
    finally:
        stop.set()
        pool.shutdown(cancel_futures=True)
        by_hand = book.adjustments()
        write_results(out, [mark(record, by_hand, policy) for record in done], default)


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
