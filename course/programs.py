"""Programs of a task: its right ways, slips and mutants, read, edited and run."""

import ast
import contextlib
import functools
import importlib
import io
import pkgutil
import re
import warnings
from dataclasses import dataclass
from types import ModuleType

import numpy as np

from course.exercise import BEGIN, END
from course.source import ROOT, read
from course.tasks import Edit
from slamlab.exercises import catalogue
from slamlab.exercises.drives.input_sets import run_sets
from slamlab.exercises.exercise import Exercise
from slamlab.exercises.run_task import run
from slamlab.exercises.task import Task

SOLUTION = "solution"
"""Name of the right way that stands in ``course/exercises``."""

STUBS = "from slamlab.grading.checks_stub import"  # as in a worker


class ProgramError(Exception):
    """A program of a task is none: its edit is not found, or changes nothing."""


@dataclass(frozen=True)
class Programs:
    """The programs of one task.

    Parameters
    ----------
    exercise : Exercise
    task : Task
    module : of ``course.tasks``
    """

    exercise: Exercise
    task: Task
    module: ModuleType

    @property
    def ways(self):
        """Right ways by name, as source of the task's functions; the solution first."""
        return {SOLUTION: _solution(self.exercise.id, self.task.drive.functions)} | getattr(
            self.module, "WAYS", {}
        )

    @property
    def slips(self):
        """The task's slips."""
        return getattr(self.module, "SLIPS", ())

    def source(self, program) -> str:
        """The source that a program stands for.

        Raises
        ------
        ProgramError
        """
        if isinstance(program, str):
            return program
        if isinstance(program, tuple):
            program = [program]
        if isinstance(program, list):
            program = Edit(SOLUTION, tuple(program))
        text = self.ways[program.way]
        for find, replace in program.pairs:
            if text.count(find) != 1:
                raise ProgramError(
                    f"{self.task.id}: {find!r} stands {text.count(find)} times in the way "
                    f"{program.way!r}; it must be found once"
                )
            text = text.replace(find, replace)
        return text

    def answers(self, source, sets):
        """What a program answers.

        Parameters
        ----------
        source : str, functions that differ from the solution
        sets : set's name to name to array

        Returns
        -------
        set's name to outputs or StudentError

        Raises
        ------
        StudentError
        """
        names = namespace(self.exercise.id, source)
        with np.errstate(all="ignore"), warnings.catch_warnings(action="ignore"):
            return run_sets(self.task.drive, names, sets)

    def verdict(self, source, seed: bytes):
        """What the judge says of a program with the inputs of a seed."""
        names = namespace(self.exercise.id, source)
        with np.errstate(all="ignore"), warnings.catch_warnings(action="ignore"):
            return run(self.task, names, self.task.draw(seed))


@functools.cache
def programs(exercise_id) -> tuple[Programs, ...]:
    """The programs of all tasks of an exercise that have some, in the exercise's order."""
    try:
        package = importlib.import_module(f"course.tasks.ex{exercise_id}")
    except ModuleNotFoundError:
        return ()
    found = {}
    for info in pkgutil.iter_modules(package.__path__):
        module = importlib.import_module(f"{package.__name__}.{info.name}")
        if hasattr(module, "TASK"):
            found[module.TASK] = module
    exercise = catalogue.exercise(exercise_id)
    return tuple(Programs(exercise, t, found[t.id]) for t in exercise.tasks if t.id in found)


def namespace(exercise_id, source="") -> dict:
    """The names that a solved notebook defines with some functions defined anew.

    Parameters
    ----------
    exercise_id : str
    source : str, run after all cells of the solution

    Returns
    -------
    dict
    """
    names = {"__name__": "__main__"}
    with contextlib.redirect_stdout(io.StringIO()):
        for code in _base(exercise_id):
            exec(code, names)
        exec(compile(source, "<cell 99>", "exec"), names)
    return names


@functools.cache
def _cells(exercise_id):
    """The solved cells of an exercise's source."""
    path = next((ROOT / "course" / "exercises").glob(f"{exercise_id}_*.py"))
    texts = [cell.text for cell in read(path).cells if cell.type == "code" and not cell.check]
    lines = [[line for line in t.splitlines() if line.strip() not in (BEGIN, END)] for t in texts]
    return tuple("\n".join(cell) for cell in lines)


@functools.cache
def _base(exercise_id):
    cells = (
        re.sub(r"^from slamlab\.checks import", STUBS, cell, flags=re.M)
        for cell in _cells(exercise_id)
        if not cell.startswith(("%", "!"))
    )
    return tuple(compile(cell, "<cell 1>", "exec") for cell in cells)


@functools.cache
def _solution(exercise_id, functions):
    """The source of some functions, without their docstrings."""
    found = []
    for cell in _cells(exercise_id):
        for node in ast.parse(cell).body:
            if isinstance(node, ast.FunctionDef | ast.ClassDef) and node.name in functions:
                found.append(_without_docstring(cell, node))
    return "\n\n".join(found)


def _without_docstring(cell, node):
    lines, first = cell.splitlines(), node.body[0]
    head = lines[node.lineno - 1 : first.lineno - 1]
    if isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant):
        return "\n".join([*head, *lines[first.end_lineno : node.end_lineno]])
    return "\n".join(lines[node.lineno - 1 : node.end_lineno])
