"""Catalogue (registry) of all exercises: one module ``tasks/exNN.py`` each, imported lazily."""

import functools
import importlib
import pkgutil
import re
from collections.abc import Mapping

from slamlab.exercises import tasks
from slamlab.exercises.exercise import Exercise
from slamlab.exercises.task import Task


class Catalogue(Mapping):
    """Exercise number to :class:`Exercise`; a module is imported when its exercise is asked for."""

    def __init__(self, package=tasks):
        self._package = package

    @functools.cached_property
    def _modules(self):
        found = (
            re.fullmatch(r"ex(\d\d)", m.name) for m in pkgutil.iter_modules(self._package.__path__)
        )
        return {match[1]: match[0] for match in found if match}

    def __getitem__(self, id) -> Exercise:
        module = self._modules[id]
        return importlib.import_module(f"{self._package.__name__}.{module}").EXERCISE

    def __iter__(self):
        return iter(sorted(self._modules))

    def __len__(self):
        return len(self._modules)


EXERCISES = Catalogue()


def exercise(id) -> Exercise:
    """Look up an exercise by its number.

    Parameters
    ----------
    id : str such as "04" or "4"

    Raises
    ------
    KeyError : with a message that names the exercises there are
    """
    try:
        return EXERCISES[id.zfill(2)]
    except KeyError:
        raise KeyError(f"no exercise {id!r}; there are {', '.join(EXERCISES)}") from None


def task(task_id) -> Task:
    """Look up a task by its id.

    Parameters
    ----------
    task_id : str such as "04-h-robot"

    Raises
    ------
    KeyError : with a message that names the tasks there are
    """
    if not re.match(r"\d\d-", str(task_id)):
        raise KeyError(
            f"no task {task_id!r}: its id is a text such as '04-h-robot', see the check below it"
        )
    of = exercise(str(task_id)[:2])
    try:
        return of.task(task_id)
    except KeyError:
        names = ", ".join(t.id for t in of.tasks)
        raise KeyError(f"no task {task_id!r}; exercise {of.id} has {names}") from None
