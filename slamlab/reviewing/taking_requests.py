"""Requests for another look are checked and put into the ledger, each once however often read."""

import hashlib

from slamlab.grading import remarks
from slamlab.grading.term import archives
from slamlab.reviewing.hand_changes import MOST_LETTERS
from slamlab.reviewing.request_cells import requests_in_notebooks
from slamlab.reviewing.requests_file import requests_in_file


def take_requests(state, place):
    """Put requests into the ledger.

    Parameters
    ----------
    state : ClassState
    place : Path, of a CSV, or of a folder or zip of notebooks

    Returns
    -------
    list of str, what to tell: how many are new, and which could not be taken

    Raises
    ------
    RequestsError
    """
    if place.is_dir() or archives.is_archive(place):
        asked, said = requests_in_notebooks(state.term, place)
    else:
        asked, said = requests_in_file(place), []
    new, known = 0, 0
    for where, *told in asked:
        try:
            student, exercise, submission, text = _checked(state, *told)
        except ValueError as error:
            said.append(f"{where}: not taken: {error}")
            continue
        key = hashlib.sha256("\0".join((student, exercise, text)).encode()).hexdigest()[:16]
        if key in state.requests:
            known += 1
            continue
        body = {"student": student, "exercise": exercise, "request": key, "text": text}
        state.book.note(remarks.REQUEST, body, submission)
        new += 1
        state.refresh()
    return [f"{place}: {new} new requests, {known} known before", *said]


def _checked(state, who, exercise, text):
    roster = state.term.roster
    student = roster.students.get(who) or next(
        filter(None, (roster.find(**{field: who}) for field in ("email", "name"))), None
    )
    if student is None:
        raise ValueError(f"{who[:80]!r} is nobody, or more than one, in the roster")
    exercise = exercise.zfill(2)
    if exercise not in state.standings:
        raise ValueError(f"the course file has no exercise {exercise[:20]!r}")
    mine = next(one for one in state.standings[exercise] if one.student.id == student.id)
    if mine.mark is None:
        raise ValueError(f"{student.id} has handed in nothing for {exercise}")
    if not 0 < len(text) <= MOST_LETTERS:
        raise ValueError(f"a request has 1 to {MOST_LETTERS} letters, not {len(text)}")
    text = text.encode("utf-8", "backslashreplace").decode().replace("\0", "")
    return student.id, exercise, mine.mark.record.submission, text
