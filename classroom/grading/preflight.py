"""Preflight: warn the student about a notebook's problems before submission."""

import ast
import re

from classroom import installed_course
from classroom.grading import syntax

SLOW = 60.0  # warn about slower notebooks; the timeout at grading is five times as long [s]
_UNDEFINED = re.compile(r"NameError: name '(\w+)' is not defined")
_FORBIDDEN = re.compile(r"ModuleNotFoundError: No module named '([\w.]+)'")


def form_warnings(cells, problems, exercise, seconds):
    """Return warnings about problems that would occur during grading, each with a remedy.
    ``problems`` are reported by a :class:`WorkerClient`; ``seconds`` is the notebook's run time.
    """
    warnings = []
    for number, problem in problems.items():
        remedy = _remedy(number, problem, cells, exercise)
        warnings.append(f"cell {number} fails: {problem}{remedy}")
    if seconds > SLOW:
        warnings.append(
            f"the notebook runs for {seconds:.0f} s; grading stops notebooks that run too long"
        )
    return warnings


def _remedy(number, problem, cells, exercise):
    """Return the remedy for a common problem, to append to the message."""
    if missing := _UNDEFINED.search(problem):
        later = [n for n, source in cells if n > number and missing[1] in _defined(source)]
        if later:
            return (
                f". Cell {later[0]} defines {missing[1]}, but grading runs cells from top to "
                "bottom. Move that cell up, then choose Kernel → Restart Kernel and Run All Cells"
            )
        return (
            f". No cell defines {missing[1]}. Choose Kernel → Restart Kernel and Run All Cells to "
            "see the error"
        )
    refused = _FORBIDDEN.search(problem)
    if refused and refused[1].partition(".")[0] in exercise.hides:
        return f". {refused[1]} is not available at grading because it solves this exercise"
    if refused and refused[1].partition(".")[0] in installed_course.own_packages():
        allowed = ", ".join(exercise.allows) or "none of slamlab's modules"
        return f". {refused[1]} is not available at grading; this exercise may use {allowed}"
    if problem.startswith("still running"):
        return ". Grading skips this cell"
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
