"""Batch grading: a folder's submissions, found, dealt out, and graded several at once."""

import re
from concurrent.futures import ThreadPoolExecutor, as_completed, wait
from hashlib import sha256
from pathlib import Path

from slamlab.grading import forked_workers, judge
from slamlab.grading.joining import Joining
from slamlab.grading.records import private_folder
from slamlab.grading.submissions import SubmissionError, in_order, read_bytes
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
    return in_order(dealt[i - 1 :: n])


def grade_locally(found, judges, known=None):
    """Grade submissions in parallel on this machine and yield records as they are done.

    Parameters
    ----------
    found : list of Submission
    judges : Judges, closed in the end; the others join the first one when that pays
    known : attempt's key to Record; these attempts are not graded again

    Yields
    ------
    Record
    """
    joining, of_each = Joining(len(found)), attempts_of_each(known)
    with ThreadPoolExecutor(max(1, judges.count), initializer=joining) as pool:
        futures = [pool.submit(judges.grade, s, of_each.get(s.name)) for s in found]
        for future in futures:
            future.add_done_callback(joining.done)
        try:
            yield from (future.result() for future in as_completed(futures))
        finally:
            for future in futures:
                future.cancel()
            judges.stop()
            joining.release()
            wait(futures)
            judges.close()  # before the threads end that workers would die with


def attempts_of_each(known):
    """Submission's name to its attempts, key to Record, of those that are known."""
    found = {}
    for key, record in (known or {}).items():
        found.setdefault(record.submission, {})[key] = record
    return found


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
    for submission in in_order(found):
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
