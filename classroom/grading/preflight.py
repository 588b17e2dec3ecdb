"""Preflight: the remedies for cells that fail, and a student's warnings before submission."""

import ast
import re

from classroom import installed_course
from classroom.grading import syntax

SLOW = 60.0  # warn about slower notebooks; the timeout at grading is five times as long [s]
_UNDEFINED = re.compile(r"NameError: name '(\w+)' is not defined")
_NO_MODULE = re.compile(r"ModuleNotFoundError: No module named '([\w.]+)'")
_REMEDIES = {  # by the beginning of a problem
    "NameError: name 'exit'": "At grading JupyterLab's exit() does not exist; delete the call",
    "EOFError": "Nobody can answer input() at grading; write the value into the cell",
    "FileNotFoundError": "Grading has the notebook alone, without your other files; write into the "
    "notebook what you need from the file",
    "still running": "Shorten or delete this cell",
}


def form_warnings(problems, seconds):
    """Return warnings about problems that would occur during grading. ``problems`` are those of
    :func:`explained`; ``seconds`` is the notebook's run time.
    """
    warnings = [f"cell {number} fails: {problem}" for number, problem in problems.items()]
    if seconds > SLOW:
        warnings.append(
            f"the notebook runs for {seconds:.0f} s; grading stops notebooks that run too long"
        )
    return warnings


def explained(problems, cells, exercise):
    """Return the problems of cells, reported by a :class:`WorkerClient`, in order, each with its
    remedy; equal remedies are stated once.
    """
    defined = {number: _defined(source) for number, source in cells} if problems else {}
    found, stated = {}, {""}
    for number, problem in sorted(problems.items()):
        remedy = _remedy(number, problem, defined, exercise)
        found[number] = problem if remedy in stated else f"{problem}. {remedy}"
        stated.add(remedy)
    return found


def _remedy(number, problem, defined, exercise):
    for begin, remedy in _REMEDIES.items():
        if problem.startswith(begin):
            return remedy
    if missing := _UNDEFINED.search(problem):
        later = [n for n, names in defined.items() if n > number and missing[1] in names]
        if later:
            return (
                f"Cell {later[0]} defines {missing[1]}, but grading runs cells from top to bottom. "
                f"Move cell {later[0]} above cell {number}"
            )
        return (
            f"No cell defines {missing[1]}. If you deleted its cell, copy it from a new copy of "
            "the exercise's notebook to the same place"
        )
    if missing := _NO_MODULE.search(problem):
        name = missing[1].partition(".")[0]
        if name in exercise.hides:
            return f"{missing[1]} is not available at grading because it solves this exercise"
        if name in installed_course.own_packages():
            allowed = ", ".join(exercise.allows) or "none of slamlab's modules"
            return f"{missing[1]} is not available at grading; this exercise may use {allowed}"
        return (
            f"{name} is not available at grading. Use the packages that the exercise imports; "
            "copy code from your own files into the notebook"
        )
    return ""


def _defined(source):
    try:
        tree = syntax.parse(source)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return set()
    found = set()
    for node in tree.body:
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            found.add(node.name)
        for part in ast.walk(node):
            if isinstance(part, ast.Name) and isinstance(part.ctx, ast.Store):
                found.add(part.id)
            elif isinstance(part, ast.alias):
                found.add((part.asname or part.name).split(".")[0])
    return found
