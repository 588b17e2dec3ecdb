"""Tables of grades as CSV: all columns, and the imports of Moodle and Canvas."""

import csv
import io
import re

from slamlab.exercises import catalogue
from slamlab.exercises.report import number
from slamlab.grading.records import write_atomically

# at the beginning, and behind what other countries' spreadsheets take for the end of a cell
_FORMULA = re.compile(r"(^\s*|;\s*)([=+\-@])")
COLUMNS = (
    "submission", "student", "exercise", "score", "max_score", "late", "handed_in", "note",
)  # fmt: skip


def write_tables(out, marks, default=None):
    """Write ``grades.csv``, ``moodle.csv`` and ``canvas.csv``.

    Parameters
    ----------
    out : Path
    marks : list of Mark
    default : str or None, an exercise whose columns stand there in any case
    """
    marks = sorted(marks, key=lambda mark: mark.record.submission)
    exercises = {mark.record.exercise for mark in marks} | {default}
    exercises = [catalogue.exercise(id) for id in sorted(filter(None, exercises))]
    write_table(out / "grades.csv", submission_rows(marks, exercises))
    write_table(out / "moodle.csv", _moodle(marks))
    write_table(out / "canvas.csv", _canvas(marks, exercises))


def submission_rows(marks, exercises):
    """One row a submission: its mark, then points per task, then per law; the titles first.

    Parameters
    ----------
    marks : list of Mark
    exercises : list of Exercise, whose tasks have columns

    Yields
    ------
    list of str
    """
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
                record.handed_in or "",
            ),
            mark.note,
            *detail_cells(mark, exercises),
        ]


def detail_titles(exercises):
    """The titles of the columns of tasks, then of laws."""
    tasks, laws = _details(exercises)
    return [*tasks, *(f"{task}: {law}" for task, law in laws)]


def detail_cells(mark, exercises):
    """The points of a mark per task, then per law, empty where there are none."""
    tasks, laws = _details(exercises)
    found = {(v.task, law.name): law.points for v in mark.record.verdicts for law in v.laws}
    cells = [mark.points.get(task) for task in tasks] + [found.get(law) for law in laws]
    return [_points(cell) for cell in cells]


def _details(exercises):
    tasks = [task for exercise in exercises for task in exercise.tasks]
    return [task.id for task in tasks], [(t.id, law.name) for t in tasks for law in t.all_laws]


def _moodle(marks):
    """Moodle's grading worksheet: told apart by the participant's number."""
    # a table without when a grade was last changed is refused; - means never
    modified = "Last modified (grade)"
    yield ["Identifier", "Full name", "Grade", "Maximum Grade", modified, "Feedback comments"]
    for mark in marks:
        record = mark.record
        who = f"Participant {record.number}" if record.number else ""
        most = number(record.max_score) if record.graded else ""
        yield [who, record.student, _points(mark.total), most, "-", mark.note]


def _canvas(marks, exercises):
    """Canvas' gradebook: a column an exercise, whose name must be that of the assignment."""
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
    """Write a table as CSV that no spreadsheet takes for formulas.

    Parameters
    ----------
    path : Path
    rows : iterable of list of str
    """
    text = io.StringIO(newline="")
    table = csv.writer(text, lineterminator="\n")
    table.writerows([_escape_formula(cell) for cell in row] for row in rows)
    write_atomically(path, text.getvalue())


def _escape_formula(text):
    """Text escaped against CSV injection: no spreadsheet takes it for a formula."""
    text = "".join(c if c.isprintable() else " " for c in text)
    if text == "-":  # how Moodle says never
        return text
    return _FORMULA.sub(r"\1'\2", text)
