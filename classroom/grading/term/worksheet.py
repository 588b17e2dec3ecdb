"""Moodle's grading worksheet of an assignment: students, submission times, grades, and participant
numbers, which differ between assignments. Moodle imports the completed table, but refuses it if a
column is missing.
"""

import re
from datetime import datetime

from classroom.grading.term.roster import RosterError, read_table

IDENTIFIER, GRADE, COMMENTS = "Identifier", "Grade", "Feedback comments"
SUBMITTED, GRADED = "Last modified (submission)", "Last modified (grade)"
EMAIL, ID = "Email address", "ID number"
_MATCHES = (("id", ID), ("id", "Username"), ("email", EMAIL), ("id", EMAIL))
_FORMATS = ("%d %B %Y, %I:%M %p", "%B %d, %Y, %I:%M %p", "%d %B %Y, %H:%M", "%d %B %Y, %I:%M:%S %p")


class Worksheet:
    """Worksheet rows by participant number; times are in time zone ``zone``. Raises RosterError."""

    def __init__(self, file, zone):
        self.titles, rows = read_table(file)
        for title in (IDENTIFIER, GRADE, GRADED):
            if title not in self.titles:
                raise RosterError(
                    f"{file} is not Moodle's grading worksheet: it has no column {title!r}. "
                    "Download it with Moodle set to English"
                )
        self.zone, self.rows = zone, {}
        for line, row in rows:
            number = re.search(r"(\d+)\s*$", row[IDENTIFIER])
            if number is None:
                raise RosterError(f"{file}, line {line}: {row[IDENTIFIER]!r} must end in a number")
            self.rows[number[1]] = row
            if row.get(SUBMITTED, "").strip() not in ("", "-") and not self.handed_in(number[1]):
                raise RosterError(
                    f"{file}, line {line}: {row[SUBMITTED]!r} is not in a known time format. "
                    "Download the worksheet with Moodle set to English"
                )

    def student(self, number, roster):
        """Return the student with a participant number, or None. The first match by ID number,
        e-mail address or full name counts.
        """
        row = self.rows.get(number, {})
        for name, title in _MATCHES:
            found = roster.find(**{name: row.get(title, "")})
            if found:
                return found
        found = roster.find(name=row.get("Full name", ""))
        return None if found and self._is_another(row, found, roster) else found

    def _is_another(self, row, student, roster):
        email, id = row.get(EMAIL, "").strip(), row.get(ID, "").strip()
        of_a_kind = any(other.get(ID, "") in roster.students for other in self.rows.values())
        return bool((email and student.email) or (id and of_a_kind))

    def handed_in(self, number):
        """Return the time of submission (ISO 8601), or None if it is missing or unreadable."""
        text = self.rows.get(number, {}).get(SUBMITTED, "").strip()
        text = re.sub(r"^[A-Za-z]+, ", "", text.replace("\u202f", " "))
        for form in _FORMATS:
            try:
                return datetime.strptime(text, form).replace(tzinfo=self.zone).isoformat()
            except ValueError:
                continue
        return None

    def without(self, student, roster):
        """Return the titles and the rows without a student, or None if nothing changes."""
        found = {number: self.student(number, roster) for number in self.rows}
        kept = [row for number, row in self.rows.items()
                if found[number] is None or found[number].id != student]  # fmt: skip
        if len(kept) == len(self.rows):
            return None
        return [self.titles, *([row.get(title, "") for title in self.titles] for row in kept)]

    def filled(self, grades):
        """Yield column titles, then rows with the (grade, comment) of each participant number."""
        titles = self.titles if COMMENTS in self.titles else [*self.titles, COMMENTS]
        yield titles
        for number, row in self.rows.items():
            grade, comment = grades.get(number, (row[GRADE], row.get(COMMENTS, "")))
            new = row | {GRADE: grade, COMMENTS: comment}
            yield [new.get(title, "") for title in titles]
