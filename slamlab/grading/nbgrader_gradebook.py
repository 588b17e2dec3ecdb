"""Export of marks to nbgrader's own gradebook, for departments that keep their grades there."""

import os
import sys
import warnings
from contextlib import contextmanager

from slamlab.exercises import catalogue


class NbgraderError(Exception):
    """nbgrader or its gradebook cannot be used; the text says why."""


def export(marks, url):
    """Export marks to nbgrader's gradebook.

    An exercise is an assignment with one notebook and a grade cell a task; students, submissions
    and cells are made where they are missing. A student's newest mark counts.

    Parameters
    ----------
    marks : list of Mark
    url : str, of nbgrader's database, such as sqlite:///gradebook.db

    Returns
    -------
    int, how many submissions were written

    Raises
    ------
    NbgraderError
    """
    try:
        from nbgrader.api import Gradebook
        from sqlalchemy.exc import SAWarning, SQLAlchemyError
    except ImportError:
        raise NbgraderError('nbgrader is not installed: pip install "slamlab[nbgrader]"') from None
    graded = [mark for mark in marks if mark.total is not None]
    try:
        with warnings.catch_warnings(), _programs_found(), Gradebook(url) as book:
            warnings.simplefilter("ignore", SAWarning)  # nbgrader's own, of its tables
            for id in sorted({mark.record.exercise for mark in graded}):
                _assignment(book, id)
            for mark in graded:
                _submission(book, mark)
    except SQLAlchemyError as error:
        said = str(error).strip().splitlines()[0]
        raise NbgraderError(f"nbgrader's gradebook cannot be filled: {said}") from None
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
        notebook.late_submission_penalty = mark.late_penalty
    book.db.commit()


@contextmanager
def _programs_found():
    """nbgrader starts a program that was installed beside Python; not every PATH names it."""
    before = os.environ.get("PATH", "")
    os.environ["PATH"] = os.pathsep.join([os.path.dirname(sys.executable), before])
    try:
        yield
    finally:
        os.environ["PATH"] = before
