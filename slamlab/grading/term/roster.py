"""Roster: who is enrolled, from the course's own table or an export of Moodle or Canvas.

Own:     id, name, email, section, canvas (the user's number there), a column an exercise that has
         extensions: 04 holds the time it is due for that student
Moodle:  First name, Last name, ID number, Email address, Groups; or a grading worksheet
Canvas:  Student, ID, SIS User ID, SIS Login ID, Section and what the gradebook holds besides
"""

import csv
import io
import re
import unicodedata
from dataclasses import dataclass, field

from slamlab.grading.term.course_file import TermError, moment

OWN = ("id", "name", "email", "section", "canvas")
_TITLES = {
    "id": ("id", "ID number", "Username", "SIS User ID", "SIS Login ID", "Email address", "ID"),
    "name": ("name", "Full name", "Student"),
    "first": ("First name", "FirstName"),
    "last": ("Last name", "Surname", "LastName"),
    "email": ("email", "Email address", "SIS Login ID"),
    "section": ("section", "Groups", "Group", "Section"),
    "canvas": ("canvas",),
}
"""Field to the titles it may have, the first that a row fills counts."""
_NOT_IN_FILES = re.compile(r"""[\x00-\x1f\x7f&<>"`|':\\/]""")
"""What Moodle leaves out of a name when it names a file."""


class RosterError(TermError):
    """The roster cannot be used; the text says why."""


@dataclass(frozen=True)
class Student:
    """Somebody who is enrolled.

    Parameters
    ----------
    id : str, what marks are kept under
    name, email, section : str, empty where the roster does not tell
    canvas : str, the user's number in Canvas, empty for none
    row : the row of the roster, title to cell, which Canvas wants back
    """

    id: str
    name: str
    email: str = ""
    section: str = ""
    canvas: str = ""
    row: dict = field(default_factory=dict, repr=False)


@dataclass(frozen=True)
class Roster:
    """All who are enrolled.

    Parameters
    ----------
    students : id to Student, in the table's order
    extensions : (id, exercise) to the time it is due
    titles : tuple of str, of the table's columns
    """

    students: dict
    extensions: dict = field(default_factory=dict)
    titles: tuple = ()

    def find(self, **told):
        """The only student who has all that is told; None for nobody or several.

        Parameters
        ----------
        told : field of :class:`Student` to its value; names count without case and spaces

        Returns
        -------
        Student or None
        """
        fields = [(name, _folded(value, name)) for name, value in told.items() if value.strip()]
        found = [s for s in self.students.values() if fields and _has(s, fields)]
        return found[0] if len(found) == 1 else None


def load(file, exercises, zone):
    """Load a roster.

    Parameters
    ----------
    file : Path, CSV with commas, semicolons or tabs
    exercises : numbers of the exercises that may have extensions
    zone : ZoneInfo, of the extensions' times

    Returns
    -------
    Roster

    Raises
    ------
    RosterError
    """
    if not file.exists():
        raise RosterError(f"{file} is not there: put your own table (id,name,email,section) in its "
                          "place, or Moodle's or Canvas' own export")  # fmt: skip
    titles, rows = read_table(file)
    if "id" in titles:
        for title in titles:
            if title not in (*OWN, *exercises):
                known = ", ".join(OWN)
                raise RosterError(f"{file}: take out the column {title!r}: there are {known}, and "
                                  f"for extensions {', '.join(exercises)}")  # fmt: skip
    students, extensions = {}, {}
    for number, row in rows:
        student = _student(row)
        if student is None:
            continue
        if not student.id:
            raise RosterError(f"{file}, line {number}: {student.name or 'somebody'} has no id")
        if student.id in students:
            raise RosterError(
                f"{file}, line {number}: the id {student.id} stands there twice; who is in two "
                "sections has one line that names both"
            )
        students[student.id] = student
        for id in exercises:
            if "id" in titles and row.get(id, "").strip():
                name = f"{file}, line {number}: {id}"
                try:
                    extensions[student.id, id] = moment(row[id], zone, name)
                except ValueError as error:
                    raise RosterError(error.args[0]) from None
    if not students:
        raise RosterError(f"{file} names nobody: one line a student, such as s123,Ana Kos")
    return Roster(students, extensions, tuple(titles))


def read_table(file):
    """Read a CSV of a spreadsheet or an LMS, with commas, semicolons or tabs.

    Parameters
    ----------
    file : Path

    Returns
    -------
    (list of titles, list of (line's number, title to cell))

    Raises
    ------
    RosterError
    """
    try:
        text = file.read_text("utf-8-sig")
    except OSError as error:
        raise RosterError(f"{file}: {error.strerror}") from None
    except UnicodeDecodeError:
        raise RosterError(f"{file}: not UTF-8; save it as CSV UTF-8") from None
    first = text.partition("\n")[0]
    separator = max(",;\t", key=first.count)
    try:
        lines = list(csv.reader(io.StringIO(text, newline=""), delimiter=separator))
    except csv.Error as error:
        raise RosterError(f"{file}: {error}") from None
    titles = [title.strip() for title in lines[0]] if lines else []
    has_id = any(title in titles for title in (*_TITLES["id"], "Identifier"))
    has_name = any(title in titles for title in (*_TITLES["name"], *_TITLES["last"]))
    if not (has_id and has_name):
        raise RosterError(f"{file}: its first line must have the titles id and name, or be that of "
                          "Moodle's or Canvas' own export in English")  # fmt: skip
    if len(set(filter(None, titles))) < len(list(filter(None, titles))):
        raise RosterError(f"{file}: a title stands there twice")
    rows = []
    for number, line in enumerate(lines[1:], 2):
        if any(cell.strip() for cell in line[len(titles) :]):
            raise RosterError(f"{file}, line {number}: more cells than titles; a text that holds "
                              f"{separator!r} stands in quotes")  # fmt: skip
        if any(map(str.strip, line)):
            rows.append((number, dict(zip(titles, line, strict=False))))
    return titles, rows


def _student(row):
    """The student of a row; None for Canvas' rows that are none."""
    told = {name: _first(row, titles) for name, titles in _TITLES.items()}
    name = told["name"] or f"{told['first']} {told['last']}".strip()
    of_canvas = "Student" in row or "LastName" in row
    if of_canvas:
        if not row.get("ID", "").strip() or name in ("Student, Test", "Test Student"):
            return None  # points possible, manual posting, the test student
        last, _, first = name.partition(", ")
        name, told["canvas"] = f"{first} {last}".strip(), row["ID"].strip()
    return Student(told["id"], name, told["email"], told["section"], told["canvas"], row)


def _first(row, titles):
    return next((row[t].strip() for t in titles if row.get(t, "").strip()), "")


def _has(student, fields):
    return all(_folded(getattr(student, name), name) == value for name, value in fields)


def _folded(text, field):
    """A cell as it is compared; ü is one letter or two, by the system that wrote it."""
    text = unicodedata.normalize("NFC", text)
    if field == "name":
        text = _NOT_IN_FILES.sub("", text.replace("_", " "))
    return re.sub(r"\s+", " ", text).strip().casefold()
