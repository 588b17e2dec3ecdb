"""Requests for another look: a CSV with the columns student, exercise and request.

Such as a form of the LMS writes; other columns are passed over. Read again, it adds what is new.
"""

import csv
import hashlib
import io

from slamlab.grading import remarks
from slamlab.grading.term.course_file import TermError
from slamlab.reviewing.hand_changes import MOST_LETTERS

TITLES = "student", "exercise", "request"
MOST_BYTES = 20_000_000


class RequestsError(TermError):
    """The file of requests cannot be used; the text says why."""


def read_requests(state, file):
    """Put a file's requests into the ledger.

    Parameters
    ----------
    state : ClassState
    file : Path

    Returns
    -------
    list of str, what to tell: how many are new, and which lines are of nobody or nothing

    Raises
    ------
    RequestsError
    """
    said, new, known = [], 0, 0
    for line, row in _rows(file):
        try:
            student, exercise, submission, text = _checked(state, row)
        except ValueError as error:
            said.append(f"{file}, line {line}: not taken: {error}")
            continue
        key = hashlib.sha256("\0".join((student, exercise, text)).encode()).hexdigest()[:16]
        if key in state.requests:
            known += 1
            continue
        body = {"student": student, "exercise": exercise, "request": key, "text": text}
        state.book.note(remarks.REQUEST, body, submission)
        new += 1
        state.refresh()
    return [f"{file}: {new} new requests, {known} known before", *said]


def _checked(state, row):
    who, exercise, text = (row[title].strip() for title in TITLES)
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


def _rows(file):
    try:
        with open(file, "rb") as stream:
            data = stream.read(MOST_BYTES + 1)
        if len(data) > MOST_BYTES:
            raise RequestsError(f"{file}: more than {MOST_BYTES // 1_000_000} MB")
        text = data.decode("utf-8-sig")
        separator = max(",;\t", key=text.partition("\n")[0].count)
        lines = csv.reader(io.StringIO(text, newline=""), delimiter=separator)
        titles = [title.strip().casefold() for title in next(lines, [])]
        missing = [title for title in TITLES if titles.count(title) != 1]
        if missing:
            raise RequestsError(f"{file}: its first line must have once each the titles "
                                f"{', '.join(TITLES)}; {', '.join(missing)} has not")  # fmt: skip
        empty = dict.fromkeys(TITLES, "")
        return [(lines.line_num, empty | dict(zip(titles, line, strict=False)))
                for line in lines if any(map(str.strip, line))]  # fmt: skip
    except OSError as error:
        raise RequestsError(f"{file}: {error.strerror}") from None
    except UnicodeDecodeError:
        raise RequestsError(f"{file}: not UTF-8; save it as CSV UTF-8") from None
    except csv.Error as error:
        raise RequestsError(f"{file}: {error}") from None
