"""Regrade requests: they are read from a CSV file or notebooks and recorded in the ledger once."""

import hashlib
import tempfile
from pathlib import Path

from classroom.grading import remarks, submissions
from classroom.grading.submissions import SubmissionError
from classroom.grading.term import archives, zipped_submissions
from classroom.reviewing.manual_changes import MAX_LENGTH
from classroom.reviewing.regrade_request_file import RegradeRequestError, requests_in_file


def take_regrade_requests(state, place):
    """Read requests from a CSV file or notebooks, record them in the ledger, and return messages;
    raise RegradeRequestError if the file is invalid."""
    if place.is_dir() or archives.is_archive(place):
        asked, messages = requests_in_notebooks(state.term, place)
    else:
        asked, messages = requests_in_file(place), []
    new, known = 0, 0
    for where, *fields in asked:
        try:
            student, exercise, record, text = _checked(state, *fields)
        except ValueError as error:
            messages.append(f"{where}: not recorded: {error}")
            continue
        key = hashlib.sha256("\0".join((student, exercise, text)).encode()).hexdigest()[:16]
        if key in state.requests:
            known += 1
            continue
        body = {"student": student, "exercise": exercise, "request": key, "text": text}
        state.book.change(remarks.REQUEST, record, **body)
        new += 1
        state.refresh()
    return [f"{place}: {new} new requests, {known} already known", *messages]


def _checked(state, who, exercise, text):
    roster = state.term.roster
    found = roster.find_any(who)
    if len(found) != 1:
        raise ValueError(roster.not_one(who))
    student = found[0]
    exercise = exercise.zfill(2)
    if exercise not in state.exercise_results:
        raise ValueError(f"the course file has no exercise {exercise[:20]!r}")
    mine = next(one for one in state.exercise_results[exercise] if one.student.id == student.id)
    if mine.mark is None:
        raise ValueError(f"{student.id} has no submission for {exercise}")
    if not 0 < len(text) <= MAX_LENGTH:
        raise ValueError(f"a request must have 1 to {MAX_LENGTH} characters, not {len(text)}")
    text = text.encode("utf-8", "backslashreplace").decode().replace("\0", "")
    return student.id, exercise, mine.mark.record, text


def requests_in_notebooks(term, place):
    """Read requests from the notebooks in a folder or zip file without running them; raise
    RegradeRequestError if none can be read.

    Returns (where, student, exercise, text), and messages about unreadable notebooks."""
    found, unread = [], []
    with tempfile.TemporaryDirectory(prefix="slamlab-zips-") as scratch:
        try:
            handed_in = zipped_submissions.collect_submissions(place, Path(scratch))
        except SubmissionError as error:
            raise RegradeRequestError(f"{place}: {error}") from None
        if not handed_in:
            raise RegradeRequestError(f"{place} contains no notebook")
        for submission in term.join(handed_in):
            where = f"{place}, {submission.name}"
            try:
                notebook = submissions.read_notebook(submission)
                if notebook.request:
                    exercise = submissions.identify_exercise(submission, notebook)
                    found.append((where, submission.student, exercise.id, notebook.request))
            except SubmissionError as error:
                unread.append(f"{where}: not read: {error}")
    return found, unread
