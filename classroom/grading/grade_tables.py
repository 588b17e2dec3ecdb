"""Grade tables (CSV): all details of each submission, and import files for Moodle and Canvas."""

import csv
import html
import io
import re

from classroom.exercises import catalogue
from classroom.exercises.verdict_text import number
from classroom.grading.local_times import local_time
from classroom.grading.records import write_atomically

# at the start of a cell, and after a semicolon, which separates cells in some countries
_FORMULA = re.compile(r"(^\s*|;\s*)([=+\-@])")
COLUMNS = (
    "submission", "student", "exercise", "score", "max_score", "late_penalty", "submitted", "note",
)  # fmt: skip


def write_tables(out, marks, default=None):
    """Write ``grades.csv``, ``moodle.csv`` and ``canvas.csv``, always with columns for the exercise
    ``default``.
    """
    marks = sorted(marks, key=lambda mark: mark.record.submission)
    write_table(out / "grades.csv", submission_rows(marks, default))
    write_table(out / "moodle.csv", _moodle(marks))
    write_table(out / "canvas.csv", _canvas(marks, _exercises(marks, default)))


def _exercises(marks, default=None):
    ids = {mark.record.exercise for mark in marks} | {default}
    return [catalogue.exercise(id) for id in sorted(filter(None, ids))]


def submission_rows(marks, default=None, zone=None):
    """Yield the column titles, then one row per submission: score, points per task and per law of
    the submitted exercises. Times are those of a time zone.
    """
    exercises = _exercises(marks, default)
    yield [*COLUMNS, *detail_titles(exercises)]
    for mark in marks:
        record = mark.record
        most = number(record.max_score) if record.graded else ""
        yield [
            *(record.submission, record.student, record.exercise or ""),
            *(
                _points(mark.total),
                most,
                _points(mark.late_penalty or None),
                local_time(record.handed_in, zone, named=True),
            ),
            mark.note,
            *detail_cells(mark, exercises),
        ]


def detail_titles(exercises):
    tasks, laws = _details(exercises)
    return [*(task.id for task in tasks), *(f"{task.id}: {law.says}" for task, law in laws)]


def detail_cells(mark, exercises):
    tasks, laws = _details(exercises)
    found = {(v.task, law.name): law.points for v in mark.record.verdicts for law in v.laws}
    cells = [mark.points.get(task.id) for task in tasks]
    cells += [found.get((task.id, law.name)) for task, law in laws]
    return [_points(cell) for cell in cells]


def _details(exercises):
    tasks = [task for exercise in exercises for task in exercise.tasks]
    return tasks, [(task, law) for task in tasks for law in task.all_laws]


def _moodle(marks):
    # Moodle requires the column of the last change of a grade; - means never
    modified = "Last modified (grade)"
    yield ["Identifier", "Full name", "Grade", "Maximum Grade", modified, "Feedback comments"]
    for mark in marks:
        record = mark.record
        who = f"Participant {record.number}" if record.number else ""
        most = number(record.max_score) if record.graded else ""
        yield [who, record.student, _points(mark.total), most, "-", moodle_comment(mark)]


def moodle_comment(mark):
    """Return the feedback comment as HTML, because Moodle shows comments as HTML."""
    return "<br>".join(html.escape(text).replace("\n", "<br>") for text in mark.sentences)


def _canvas(marks, exercises):
    """Yield the rows of Canvas's gradebook, with one column per exercise, named after the
    assignment.
    """
    yield ["Student", "ID", "SIS User ID", "SIS Login ID", "Section", *(e.title for e in exercises)]
    yield ["Points Possible", "", "", "", "", *(number(e.points) for e in exercises)]
    by_student = {}
    for mark in marks:
        key = mark.record.student, mark.record.number or ""
        by_student.setdefault(key, {})[mark.record.exercise] = mark.total
    for (student, id), totals in by_student.items():
        yield [student, id, "", "", "", *(_points(totals.get(e.id)) for e in exercises)]


def _points(value):
    return "" if value is None else number(value)


def write_table(path, rows):
    """Write rows of text as CSV; the text is escaped against formula injection."""
    text = io.StringIO(newline="")
    table = csv.writer(text, lineterminator="\n")
    table.writerows([_escape_formula(cell) for cell in row] for row in rows)
    write_atomically(path, text.getvalue())


def _escape_formula(text):
    """Return text that no spreadsheet interprets as a formula (CSV injection)."""
    text = "".join(c if c.isprintable() else " " for c in text)
    if text == "-":  # Moodle's sign for never
        return text
    return _FORMULA.sub(r"\1'\2", text)
