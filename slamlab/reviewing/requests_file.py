"""Requests for another look in a CSV with the columns student, exercise and request.

Such as a form of the LMS writes; other columns are passed over.
"""

import csv
import io

from slamlab.grading.term.course_file import TermError

TITLES = "student", "exercise", "request"
MOST_BYTES = 20_000_000


class RequestsError(TermError):
    """What holds requests cannot be used; the text says why."""


def requests_in_file(file):
    """The requests of a file, nothing of them checked.

    Parameters
    ----------
    file : Path

    Returns
    -------
    list of (where it stands, student, exercise, text), all str

    Raises
    ------
    RequestsError
    """
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
                                f"{', '.join(TITLES)}; not so: {', '.join(missing)}")  # fmt: skip
        empty = dict.fromkeys(TITLES, "")
        rows = [(lines.line_num, empty | dict(zip(titles, line, strict=False)))
                for line in lines if any(map(str.strip, line))]  # fmt: skip
        return [(f"{file}, line {number}", *(row[title].strip() for title in TITLES))
                for number, row in rows]  # fmt: skip
    except OSError as error:
        raise RequestsError(f"{file}: {error.strerror}") from None
    except UnicodeDecodeError:
        raise RequestsError(f"{file}: not UTF-8; save it as CSV UTF-8") from None
    except csv.Error as error:
        raise RequestsError(f"{file}: {error}") from None
