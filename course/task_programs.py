"""Programs of a task (right programs, mistakes and mutants): reading, editing and running them."""

import ast
import contextlib
import functools
import io
import re
import warnings
from dataclasses import dataclass

import numpy as np

from classroom.exercises import catalogue
from classroom.exercises.exercise import Exercise
from classroom.exercises.function_calls.run_and_pack import call_on_sets
from classroom.exercises.run_task import run
from classroom.exercises.task import Task
from course import answers, mistakes, quantity_texts
from course.mistakes import SOLUTION
from course.solution_cells import BEGIN, END
from course.source import ROOT, numbered, read

EXERCISES = ROOT / "course" / "exercises"
STUBS = "from classroom.grading.checks_stub import"  # as in a worker


class ProgramError(Exception):
    """A program of a task is invalid: the text to edit is not found, or the edit changes
    nothing."""


@dataclass(frozen=True)
class Programs:
    """The programs of one task.

    Parameters
    ----------
    exercise : Exercise
    task : Task
    """

    exercise: Exercise
    task: Task

    @property
    def folder(self):
        """The task's folder, see :func:`folder_of`."""
        return folder_of(self.task.id)

    @functools.cached_property
    def file(self):
        """The content of ``mistakes.txt``."""
        return mistakes.read(self.folder / "mistakes.txt")

    @functools.cached_property
    def answers(self):
        """The programs of ``answers.py``, a list of Answer."""
        return answers.read(self.folder / "answers.py")

    @property
    def ways(self):
        """The right programs by name, as source of the task's functions; the solution is first."""
        solution = _solution(self.exercise.id, self.task.call.functions)
        others = {answer.what: answer.source for answer in self.answers if answer.kind == "way"}
        return {SOLUTION: solution} | others

    @property
    def mistakes(self):
        """The named mistakes of the task."""
        return self.file.mistakes

    def names_of(self, mistake):
        """The names by which a mistake may be recognised: its own, and those that precede it."""
        before = (other.name for other in self.mistakes if mistake.name in other.before)
        return {mistake.name, *before}

    def source(self, program) -> str:
        """Return the source of a program.

        Raises
        ------
        ProgramError
        """
        if isinstance(program, str):
            return program
        text = program.above or self.ways.get(program.way)
        if text is None:
            raise ProgramError(f"{self.task.id}: there is no right program {program.way!r}")
        for find, replace in program.pairs:
            if text.count(find) != 1:
                raise ProgramError(
                    f"{self.task.id}: {find!r} occurs {text.count(find)} times in the program "
                    f"{program.way!r}; it must occur once"
                )
            text = text.replace(find, replace)
        return text

    def outputs(self, source, sets):
        """Run a program on sets of inputs.

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
            return call_on_sets(self.task.call, names, sets)

    def verdict(self, source, seed: bytes):
        """Judge a program on the inputs of a seed."""
        names = namespace(self.exercise.id, source)
        with np.errstate(all="ignore"), warnings.catch_warnings(action="ignore"):
            return run(self.task, names, self.task.draw_inputs(seed))


@functools.cache
def programs(exercise_id) -> tuple[Programs, ...]:
    """Return the programs of an exercise's tasks in the order of the exercise."""
    exercise = catalogue.exercise(exercise_id)
    found = (Programs(exercise, task) for task in exercise.tasks)
    return tuple(one for one in found if (one.folder / "mistakes.txt").is_file())


def folder_of(task_id):
    """Return the folder of a task, such as ``course/exercises/ex06_ekf_slam/augment``."""
    exercise, _, name = task_id.partition("-")
    return EXERCISES / catalogue.folders()[exercise] / name.replace("-", "_")


def namespace(exercise_id, source="") -> dict:
    """Return the namespace of a solved notebook with some functions redefined.

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
def visible_names(task_id):
    """Return the names that a student sees in the section of a task."""
    cells = read(numbered(task_id[:2], "exercises")).cells
    checks = [k for k, cell in enumerate(cells) if cell.check]
    end = next((k for k in checks if cells[k].check == task_id), len(cells))
    begin = max((k for k in checks if k < end), default=0)
    return quantity_texts.visible_names(cells[begin:end])


@functools.cache
def _cells(exercise_id):
    """Return the solved cells of an exercise's source."""
    cells = read(numbered(exercise_id, "exercises")).cells
    texts = [cell.text for cell in cells if cell.type == "code" and not cell.check]
    lines = [[line for line in t.splitlines() if line.strip() not in (BEGIN, END)] for t in texts]
    return tuple("\n".join(cell) for cell in lines)


@functools.cache
def _base(exercise_id):
    cells = (
        re.sub(r"^from classroom\.checks import", STUBS, cell, flags=re.M)
        for cell in _cells(exercise_id)
        if not cell.startswith(("%", "!"))
    )
    return tuple(compile(cell, "<cell 1>", "exec") for cell in cells)


@functools.cache
def _solution(exercise_id, functions):
    """Return the source of some functions, without their docstrings."""
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
