"""Requests for another look in notebooks: a text cell under the heading "Request for another look".

The notebook comes by mail or as a download of an assignment made for it. Nothing of it is run, and
it is no attempt.
"""

import tempfile
from pathlib import Path

from slamlab.grading import submissions
from slamlab.grading.submissions import SubmissionError
from slamlab.grading.term import hand_ins
from slamlab.reviewing.requests_file import RequestsError


def requests_in_notebooks(term, place):
    """The requests in the notebooks of a folder or a zip; those without one are passed over.

    Parameters
    ----------
    term : Term, whose roster says whose each is
    place : Path

    Returns
    -------
    list of (where it stands, student, exercise, text), all str
    list of str, which notebooks could not be read, and why

    Raises
    ------
    RequestsError
    """
    found, unread = [], []
    with tempfile.TemporaryDirectory(prefix="slamlab-zips-") as scratch:
        try:
            handed_in = hand_ins.find_hand_ins(place, Path(scratch))
        except SubmissionError as error:
            raise RequestsError(f"{place}: {error}") from None
        if not handed_in:
            raise RequestsError(f"{place}: no notebook in it")
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
