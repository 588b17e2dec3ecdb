"""Preflight: warnings about a notebook's form, for the student before the submission."""

import ast
import re

from slamlab.grading import syntax

SLOW = 60.0  # warning for a whole notebook; its timeout at grading is five times as long [s]
_UNDEFINED = re.compile(r"NameError: name '(\w+)' is not defined")
_FORBIDDEN = re.compile(r"ModuleNotFoundError: No module named '([\w.]+)'")


def form_warnings(cells, problems, exercise, seconds):
    """Warnings about what fails at grading (cells, imports, run time), and what to do about it.

    Parameters
    ----------
    cells : list of (number, source)
    problems : cell's number to what went wrong in it, as :class:`WorkerClient` tells
    exercise : Exercise
    seconds : float, what the whole took [s]

    Returns
    -------
    list of str
    """
    said = []
    for number, problem in problems.items():
        way_out = _remedy(number, problem, cells, exercise)
        said.append(f"cell {number} did not run to its end: {problem}{way_out}")
    if seconds > SLOW:
        said.append(f"it took {seconds:.0f} s: grading stops a notebook that takes too long")
    return said


def _remedy(number, problem, cells, exercise):
    """The way out of the commonest problems, as the end of a sentence."""
    if missing := _UNDEFINED.search(problem):
        later = [n for n, source in cells if n > number and missing[1] in _defined(source)]
        if later:
            return (
                f". Cell {later[0]} defines {missing[1]}, but cells are graded from top to bottom: "
                "move it up, then Kernel → Restart Kernel and Run All Cells"
            )
        return ". Was its cell deleted? Kernel → Restart Kernel and Run All Cells shows it"
    refused = _FORBIDDEN.search(problem)
    if refused and refused[1].partition(".")[0] in exercise.hides:
        return f". {refused[1]} is not there at grading: it would answer this exercise"
    if refused and refused[1].partition(".")[0] == "slamlab":
        allowed = ", ".join(exercise.allows) or "none of slamlab's modules"
        return f". {refused[1]} is not there at grading; this exercise may use {allowed}"
    if problem.startswith("still running"):
        return ". At grading it is left out"
    return ""


def _defined(source):
    """The names a cell defines at its top."""
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
