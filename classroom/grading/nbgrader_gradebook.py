"""Export scores to nbgrader's gradebook, for departments that keep their grades there."""

import os
import sys
import warnings
from contextlib import contextmanager

from classroom.exercises import catalogue
from slamlab.extras import needs


class NbgraderError(Exception):
    """nbgrader or its gradebook cannot be used; the message states why."""


def export(marks, url):
    """Export marks to nbgrader's database; return the number of submissions. An exercise becomes an
    assignment with one grade cell per task; missing entries are created. Raises NbgraderError.
    """
    with needs("nbgrader", "slam-course"):
        from nbgrader.api import Gradebook
        from sqlalchemy.exc import SAWarning, SQLAlchemyError
    graded = [mark for mark in marks if mark.total is not None]
    try:
        with warnings.catch_warnings(), _programs_found(), Gradebook(url) as book:
            warnings.simplefilter("ignore", SAWarning)  # about nbgrader's tables
            for id in sorted({mark.record.exercise for mark in graded}):
                _assignment(book, id)
            for mark in graded:
                _submission(book, mark)
    except SQLAlchemyError as error:
        message = str(error).strip().splitlines()[0]
        raise NbgraderError(f"nbgrader's gradebook cannot be written: {message}") from None
    return len(graded)


def _assignment(book, id):
    exercise = catalogue.exercise(id)
    name = exercise.notebook
    book.update_or_create_assignment(name)
    book.update_or_create_notebook(name, name)
    for task in exercise.tasks:
        cell = {"max_score": task.points, "cell_type": "code"}
        book.update_or_create_grade_cell(task.id, name, name, **cell)


def _submission(book, mark):
    record = mark.record
    name, student = catalogue.exercise(record.exercise).notebook, record.student
    book.update_or_create_student(student)
    when = {"timestamp": record.handed_in} if record.handed_in else {}
    submission = book.update_or_create_submission(name, student, **when)
    for task, points in mark.points.items():
        grade = book.find_grade(task, name, name, student)
        grade.auto_score, grade.needs_manual_grade = points, False
        if task in mark.override_reasons:
            grade.manual_score = points
    if mark.late_penalty:
        notebook = submission.notebooks[0]
        notebook.late_submission_penalty = round(mark.late_penalty, 6)
    book.db.commit()


@contextmanager
def _programs_found():
    """Add Python's folder to PATH, because nbgrader starts a program installed there."""
    before = os.environ.get("PATH", "")
    os.environ["PATH"] = os.pathsep.join([os.path.dirname(sys.executable), before])
    try:
        yield
    finally:
        os.environ["PATH"] = before
