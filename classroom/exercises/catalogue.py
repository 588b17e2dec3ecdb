"""The catalogue of all exercises: each is a package ``exercises.exNN_topic``, imported lazily."""

import functools
import pkgutil
import re
from collections.abc import Mapping

from classroom import installed_course
from classroom.exercises.exercise import Exercise
from classroom.exercises.task import Task


@functools.cache
def folders() -> dict[str, str]:
    """Return the name of each exercise's folder, such as "ex06_ekf_slam", by its number."""
    found = (
        re.fullmatch(r"ex(\d\d)_\w+", m.name)
        for m in pkgutil.iter_modules(installed_course.module("exercises").__path__)
    )
    return {match[1]: match[0] for match in found if match}


def file(id, name):
    """Locate a data file of an exercise; the file, or the exercise, may not exist."""
    return installed_course.file("exercises", folders().get(id, "none"), name)


class Catalogue(Mapping):
    """Maps an exercise number to its :class:`Exercise`, imported on access."""

    def __getitem__(self, id) -> Exercise:
        return installed_course.module(f"exercises.{folders()[id]}.exercise").EXERCISE

    def __iter__(self):
        return iter(sorted(folders()))

    def __len__(self):
        return len(folders())


EXERCISES = Catalogue()


def exercise(id) -> Exercise:
    """Look up an exercise by its number, "04" or "4". Raises KeyError."""
    try:
        return EXERCISES[id.zfill(2)]
    except KeyError:
        raise KeyError(f"no exercise {id!r}: the exercises are {', '.join(EXERCISES)}") from None


def task(task_id) -> Task:
    """Look up a task by its id, such as "04-h-robot". Raises KeyError."""
    if not re.match(r"\d\d-", str(task_id)):
        raise KeyError(
            f"no task {task_id!r}: give an id such as '04-h-robot', as in the check below each task"
        )
    of = exercise(str(task_id)[:2])
    try:
        return of.task(task_id)
    except KeyError:
        names = ", ".join(t.id for t in of.tasks)
        raise KeyError(f"no task {task_id!r}: the tasks of exercise {of.id} are {names}") from None
