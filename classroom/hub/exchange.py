"""Collecting submissions from the homes of students, and returning their feedback.

A submission is the exercise's notebook in the student's course folder. It is copied to
``OUT/STUDENT/``; its time is that of the collection that first found these bytes, because a student
can change the time of a file."""

import os
from pathlib import Path, PurePosixPath

from classroom.coursework import originals
from classroom.coursework.file_writing import write
from classroom.exercises import catalogue
from classroom.grading.term.releases import file_name
from classroom.hub import user_folders
from classroom.hub.student_server import FOLDER, INSTALLATION

MAX_NOTEBOOK_BYTES = 20 << 20  # as the grader accepts


def collect(students, users: Path, exercise: str, out: Path):
    """Copy each student's notebook of an exercise, and return (int, int, list of str): new or
    changed notebooks, unchanged ones, and messages about the others.

    Parameters
    ----------
    students : list of str, names of the homes
    users : Path, the folder of all homes, such as /home
    exercise : str, such as "04"
    out : Path, for ``STUDENT/exNN_….ipynb``
    """
    path = PurePosixPath(FOLDER, "exercises", catalogue.exercise(exercise).file)
    handed_out = originals.original(INSTALLATION, f"exercises/{path.name}")
    new = same = 0
    problems = []
    for student in students:
        try:
            with user_folders.opened_user_folder(users, student) as (home, owner):
                data = user_folders.read(home, owner, path, MAX_NOTEBOOK_BYTES)
        except user_folders.UserFolderError as error:
            problems.append(f"{student}: {error}")
            continue
        if data == handed_out:
            problems.append(f"{student}: the notebook is as it was handed out")
            continue
        target = out / student / path.name
        if target.is_file() and target.read_bytes() == data:
            same += 1
        else:
            write(target, data)
            new += 1
    return new, same, problems


def give_back(students, users: Path, exercise: str, feedback: Path):
    """Write each student's feedback page into the course folder in the home.

    The parameters are those of :func:`collect`; feedback : Path, folder of ``STUDENT.html``.
    Returns messages about what was done."""
    count, problems = 0, []
    for student in students:
        page = feedback / f"{file_name(student)}.html"
        if not page.is_file():
            continue
        path = PurePosixPath(FOLDER, "feedback", f"exercise-{exercise}.html")
        try:
            with user_folders.opened_user_folder(users, student) as (home, owner):
                user_folders.replace(home, owner, path, page.read_bytes())
            count += 1
        except (user_folders.UserFolderError, OSError) as error:
            problems.append(f"not returned: {student}: {error}")
    return [f"{count} feedback pages are in the homes", *problems]


def users_in(folder: Path):
    """Return the sorted names of all homes in a folder, without hidden ones."""
    with os.scandir(folder) as entries:
        kept = (e.name for e in entries if e.is_dir(follow_symlinks=False))
        return sorted(name for name in kept if not name.startswith("."))
