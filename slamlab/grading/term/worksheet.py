"""Moodle's grading worksheet of an assignment: who a number is, when it was handed in, the grade.

A participant's number is another one in every assignment; only its worksheet joins it to a person.
Moodle takes the same table in again with grades and comments filled in, and refuses one that lacks
a column of its own.
"""

import re
from datetime import datetime

from slamlab.grading.term.roster import RosterError, read_table

IDENTIFIER, GRADE, COMMENTS = "Identifier", "Grade", "Feedback comments"
SUBMITTED, GRADED = "Last modified (submission)", "Last modified (grade)"
EMAIL, ID = "Email address", "ID number"
_WAYS = (("id", ID), ("id", "Username"), ("email", EMAIL), ("id", EMAIL))
_FORMATS = ("%d %B %Y, %I:%M %p", "%B %d, %Y, %I:%M %p", "%d %B %Y, %H:%M", "%d %B %Y, %I:%M:%S %p")


class Worksheet:
    """The rows of a worksheet by the participant's number.

    Parameters
    ----------
    file : Path
    zone : ZoneInfo, of its times

    Raises
    ------
    RosterError : it is no worksheet
    """

    def __init__(self, file, zone):
        self.titles, rows = read_table(file)
        for title in (IDENTIFIER, GRADE, GRADED):
            if title not in self.titles:
                raise RosterError(
                    f"{file}: not Moodle's grading worksheet: no column {title!r} "
                    "(download it with Moodle in English)"
                )
        self.zone, self.rows = zone, {}
        for line, row in rows:
            number = re.search(r"(\d+)\s*$", row[IDENTIFIER])
            if number is None:
                raise RosterError(f"{file}, line {line}: {row[IDENTIFIER]!r} has no number")
            self.rows[number[1]] = row
            if row.get(SUBMITTED, "").strip() not in ("", "-") and not self.handed_in(number[1]):
                raise RosterError(
                    f"{file}, line {line}: {row[SUBMITTED]!r} is no time that is read "
                    "(download it with Moodle in English)"
                )

    def student(self, number, roster):
        """The student of a participant's number: by ID number, else e-mail, else full name.

        Parameters
        ----------
        number : str
        roster : Roster

        Returns
        -------
        Student or None
        """
        row = self.rows.get(number, {})
        for name, title in _WAYS:
            found = roster.find(**{name: row.get(title, "")})
            if found:
                return found
        found = roster.find(name=row.get("Full name", ""))
        return None if found and self._is_another(row, found, roster) else found

    def _is_another(self, row, student, roster):
        """Whether somebody of the same name has another e-mail or ID number."""
        email, id = row.get(EMAIL, "").strip(), row.get(ID, "").strip()
        of_a_kind = any(other.get(ID, "") in roster.students for other in self.rows.values())
        return bool((email and student.email) or (id and of_a_kind))

    def handed_in(self, number):
        """When it was handed in (ISO 8601); None where Moodle does not tell in a way it is read.

        Parameters
        ----------
        number : str
        """
        text = self.rows.get(number, {}).get(SUBMITTED, "").strip()
        text = re.sub(r"^[A-Za-z]+, ", "", text.replace("\u202f", " "))
        for form in _FORMATS:
            try:
                return datetime.strptime(text, form).replace(tzinfo=self.zone).isoformat()
            except ValueError:
                continue
        return None

    def without(self, student, roster):
        """The worksheet without a student: rows as of :meth:`filled`; None where he is not in it.

        Parameters
        ----------
        student : str, an id
        roster : Roster, which still has him
        """
        found = {number: self.student(number, roster) for number in self.rows}
        kept = [row for number, row in self.rows.items()
                if found[number] is None or found[number].id != student]  # fmt: skip
        if len(kept) == len(self.rows):
            return None
        return [self.titles, *([row.get(title, "") for title in self.titles] for row in kept)]

    def filled(self, grades):
        """The worksheet with grades and comments filled in.

        Parameters
        ----------
        grades : participant's number to (grade, comment), text

        Yields
        ------
        list of str, a row; the first has the titles
        """
        titles = self.titles if COMMENTS in self.titles else [*self.titles, COMMENTS]
        yield titles
        for number, row in self.rows.items():
            grade, comment = grades.get(number, (row[GRADE], row.get(COMMENTS, "")))
            new = row | {GRADE: grade, COMMENTS: comment}
            yield [new.get(title, "") for title in titles]
