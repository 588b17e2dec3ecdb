"""Roster of enrolled students, from your own table or an export from Moodle or Canvas.

Own:     id, name, email, section, canvas (user number in Canvas)
Moodle:  First name, Last name, ID number, Email address, Groups; or a grading worksheet
Canvas:  Student, ID, SIS User ID, SIS Login ID, Section, and further columns of the gradebook
All:     one column for each exercise with extensions, such as 04, with the student's due date
"""

import csv
import io
import re
import unicodedata
from dataclasses import dataclass, field

from classroom.grading.term.course_file import TermError, parse_time

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
"""The possible titles of each field; the first column with a value counts."""
_LIKE_EXERCISE = re.compile(r"(?:ex|exercise)?[\s._-]*\d{1,2}", re.IGNORECASE)
"""Titles that probably mean the extensions of an exercise."""
_STUDENT = re.compile(r"\b(student|learner)", re.IGNORECASE)
_NOT_IN_FILES = re.compile(r"""[\x00-\x1f\x7f&<>"`|':\\/]""")
"""Characters that Moodle removes from students' names in file names."""


class RosterError(TermError):
    """The roster cannot be used; the message states why."""


@dataclass(frozen=True)
class Student:
    """An enrolled student; fields that are not in the roster are empty."""

    id: str  # under which marks are stored
    name: str
    email: str = ""
    section: str = ""
    canvas: str = ""  # the user's number in Canvas
    row: dict = field(default_factory=dict, repr=False)  # title to cell, for Canvas' import


@dataclass(frozen=True)
class Roster:
    """All enrolled students."""

    students: dict  # id to Student, in the table's order
    extensions: dict = field(default_factory=dict)  # (id, exercise) to the extended due date
    titles: tuple = ()  # of the table's columns
    warnings: tuple = ()  # about persons who are no students

    def find(self, **fields):
        """Return the only student with these fields, or None if none or several have them."""
        found = self.find_all(**fields)
        return found[0] if len(found) == 1 else None

    def find_all(self, **fields):
        """Return all students with these fields; empty fields do not count. If no student has a
        name, the students count whose names have the same words in another order.
        """
        wanted = [(name, _folded(value, name)) for name, value in fields.items() if value.strip()]
        found = [s for s in self.students.values() if wanted and _has(s, wanted)]
        if found or [name for name, _ in wanted] != ["name"]:
            return found
        words = _words(wanted[0][1])
        return [s for s in self.students.values() if _words(_folded(s.name, "name")) == words]

    def find_any(self, name):
        """Return all students with an id, or else an e-mail address, or else a name."""
        fields = ({"id": name}, {"email": name}, {"name": name})
        return next(filter(None, (self.find_all(**field) for field in fields)), [])

    def not_one(self, name):
        """State that a name belongs to no student or to several students."""
        ids = " and ".join(student.id for student in self.find_any(name))
        if ids:
            return f"{name!r} is the name of {ids} in the roster; give the id"
        return f"{name[:80]!r} is not in the roster"


def load(file, exercises, zone):
    """Load a roster; ``exercises`` may have columns with extensions, in time zone ``zone``. Raises
    RosterError.
    """
    if not file.exists():
        raise RosterError(f"the roster {file} does not exist. Create a table with the "
                          "columns id,name,email,section, or export one from Moodle or "
                          "Canvas")  # fmt: skip
    titles, rows = read_table(file)
    has_id = any(title in titles for title in (*_TITLES["id"], "Identifier"))
    has_name = any(title in titles for title in (*_TITLES["name"], *_TITLES["last"]))
    if not (has_id and has_name):
        raise RosterError(f"{file}: the first line must have the titles id and name, or those of "
                          "an English Moodle or Canvas export")  # fmt: skip
    for title in titles:
        other = ("id" in titles and title not in OWN) or _LIKE_EXERCISE.fullmatch(title)
        if other and title not in exercises:
            known = f"Valid titles are {', '.join(OWN)}, and for" if "id" in titles else "For"
            raise RosterError(f"{file}: delete the column {title!r}. {known} extensions "
                              f"{', '.join(exercises)}")  # fmt: skip
    students, extensions, warnings = {}, {}, []
    with_roles = any(_STUDENT.search(row.get("Roles", "")) for _, row in rows)
    for number, row in rows:
        student = _student(row)
        if student is None:
            continue
        if with_roles and not _STUDENT.search(row["Roles"]):
            warnings.append(f"{file.name}: {student.name} is not a student ({row['Roles']})")
            continue
        if not student.id:
            raise RosterError(f"{file}, line {number}: {student.name or 'a student'} has no id")
        if student.id in students:
            raise RosterError(
                f"{file}, line {number}: the id {student.id} occurs twice. If a student is in two "
                "sections, name both in one line"
            )
        students[student.id] = student
        for id in exercises:
            if row.get(id, "").strip():
                name = f"{file}, line {number}: {id}"
                try:
                    extensions[student.id, id] = parse_time(row[id], zone, name)
                except ValueError as error:
                    raise RosterError(error.args[0]) from None
    if not students:
        raise RosterError(
            f"{file} lists no students. Add one line per student, such as s123,Ana Kos"
        )
    return Roster(students, extensions, tuple(titles), tuple(warnings))


def read_table(file):
    """Read a CSV file whose separators are commas, semicolons or tabs. Return the column titles,
    and the rows as (line number, dict from title to cell). Raises RosterError.
    """
    try:
        text = file.read_text("utf-8-sig")
    except OSError as error:
        raise RosterError(f"{file}: {error.strerror}") from None
    except UnicodeDecodeError:
        raise RosterError(f"{file} is not UTF-8; save it as CSV UTF-8") from None
    first = text.partition("\n")[0]
    separator = max(",;\t", key=first.count)
    try:
        lines = list(csv.reader(io.StringIO(text, newline=""), delimiter=separator))
    except csv.Error as error:
        raise RosterError(f"{file}: {error}") from None
    titles = [title.strip() for title in lines[0]] if lines else []
    if len(set(filter(None, titles))) < len(list(filter(None, titles))):
        raise RosterError(f"{file}: a title occurs twice")
    rows = []
    for number, line in enumerate(lines[1:], 2):
        if any(cell.strip() for cell in line[len(titles) :]):
            raise RosterError(f"{file}, line {number}: there are more cells than titles. Put texts "
                              f"that contain {separator!r} in quotes")  # fmt: skip
        if any(map(str.strip, line)):
            rows.append((number, dict(zip(titles, line, strict=False))))
    return titles, rows


def _student(row):
    """Return the student of a row, or None for Canvas rows that are not students."""
    fields = {name: _first(row, titles) for name, titles in _TITLES.items()}
    name = fields["name"] or f"{fields['first']} {fields['last']}".strip()
    of_canvas = "Student" in row or "LastName" in row
    if of_canvas:
        if not row.get("ID", "").strip() or name in ("Student, Test", "Test Student"):
            return None  # points possible, manual posting, the test student
        last, _, first = name.partition(", ")
        name, fields["canvas"] = f"{first} {last}".strip(), row["ID"].strip()
    rest = (fields[name] for name in ("email", "section", "canvas"))
    return Student(fields["id"], name, *rest, row)


def _first(row, titles):
    return next((row[t].strip() for t in titles if row.get(t, "").strip()), "")


def _words(name):
    return sorted(name.replace(",", " ").split())


def _has(student, fields):
    return all(_folded(getattr(student, name), name) == value for name, value in fields)


def _folded(text, field):
    """Normalise a cell for comparison, because systems write ü as one character or as two."""
    text = unicodedata.normalize("NFC", text)
    if field == "name":
        text = _NOT_IN_FILES.sub("", text.replace("_", " "))
    return re.sub(r"\s+", " ", text).strip().casefold()
