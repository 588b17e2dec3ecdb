"""Regrade requests in a CSV file, for example from an LMS, with columns student, exercise,
request."""

import csv
import io

from classroom.grading.term.course_file import TermError

TITLES = "student", "exercise", "request"
MAX_BYTES = 20_000_000


class RegradeRequestError(TermError):
    """A file of requests is invalid; the message explains why."""


def requests_in_file(file):
    """Return the unchecked requests in a file, (where, student, exercise, text); raise
    RegradeRequestError if the file is invalid."""
    try:
        with open(file, "rb") as stream:
            data = stream.read(MAX_BYTES + 1)
        if len(data) > MAX_BYTES:
            raise RegradeRequestError(f"{file} is larger than {MAX_BYTES // 1_000_000} MB")
        text = data.decode("utf-8-sig")
        separator = max(",;\t", key=text.partition("\n")[0].count)
        lines = csv.reader(io.StringIO(text, newline=""), delimiter=separator)
        titles = [title.strip().casefold() for title in next(lines, [])]
        missing = [title for title in TITLES if titles.count(title) != 1]
        if missing:
            raise RegradeRequestError(
                f"{file}: the first line must contain each title of {', '.join(TITLES)} once. "
                f"Check {', '.join(missing)}"
            )
        empty = dict.fromkeys(TITLES, "")
        rows = [(lines.line_num, empty | dict(zip(titles, line, strict=False)))
                for line in lines if any(map(str.strip, line))]  # fmt: skip
        return [(f"{file}, line {number}", *(row[title].strip() for title in TITLES))
                for number, row in rows]  # fmt: skip
    except OSError as error:
        raise RegradeRequestError(f"{file}: {error.strerror}") from None
    except UnicodeDecodeError:
        raise RegradeRequestError(f"{file} is not UTF-8. Save it as CSV UTF-8") from None
    except csv.Error as error:
        raise RegradeRequestError(f"{file}: {error}") from None
