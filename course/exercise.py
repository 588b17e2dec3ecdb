"""Strip solutions: stubs in a solved exercise in place of its solutions, nbgrader's metadata."""

import ast

BEGIN, END = "### BEGIN SOLUTION", "### END SOLUTION"
STUB = 'raise NotImplementedError("your code here")'
PROTECTED = {"deletable": False, "editable": False}
VALIDATE = """\
# Save first: this runs what stands in the file, from top to bottom, as the grader will.
from slamlab.checks import validate

validate()"""
"""The last cell of every exercise."""


class SolutionError(Exception):
    """A solution is marked wrongly; ``line`` counts from 1 in the cell."""

    def __init__(self, line, message):
        super().__init__(message)
        self.line, self.message = line, message


def solution_regions(text):
    """Find and check the solutions of a cell: balanced marks, whole statements in one function.

    Parameters
    ----------
    text : str, the cell's source

    Returns
    -------
    list of (first, last) : lines of the marks, counted from 1

    Raises
    ------
    SolutionError
    """
    found, begin = [], None
    for number, line in enumerate(text.splitlines(), 1):
        if line.strip() == BEGIN:
            if begin:
                raise SolutionError(number, f"{BEGIN} again before {END}")
            begin = number
        elif line.strip() == END:
            if not begin:
                raise SolutionError(number, f"{END} without {BEGIN}")
            found.append((begin, number))
            begin = None
        elif "SOLUTION" in line:
            raise SolutionError(number, f"write the marks exactly {BEGIN} and {END}")
    if begin:
        raise SolutionError(begin, f"{BEGIN} without {END}")
    if found:
        tree = ast.parse(text)
        for first, last in found:
            _inside_function(tree, first, last)
    return found


def strip_solutions(text):
    """Strip a cell: every solution is replaced by a stub; indentation and docstrings stay.

    Parameters
    ----------
    text : str, the cell's source

    Returns
    -------
    str

    Raises
    ------
    SolutionError
    """
    lines = text.splitlines()
    for first, last in reversed(solution_regions(text)):
        mark = lines[first - 1]
        indent = mark[: len(mark) - len(mark.lstrip())]
        lines[first - 1 : last] = [indent + STUB]
    stripped = "\n".join(lines)
    try:
        ast.parse(stripped)
    except SyntaxError as error:
        raise SolutionError(
            error.lineno or 1, "without its solution the cell is no Python"
        ) from None
    return stripped


def solution_lines(text):
    """The lines of code that stand inside solutions, stripped of indentation.

    Parameters
    ----------
    text : str, the cell's source

    Returns
    -------
    list of str
    """
    lines = text.splitlines()
    return [
        line.strip()
        for first, last in solution_regions(text)
        for line in lines[first : last - 1]
        if line.strip() and not line.strip().startswith("#")
    ]


def solution_metadata(id):
    """nbgrader's metadata of a solution cell, which a student fills in, with its protection."""
    return {"nbgrader": _nbgrader(id, solution=True), "deletable": False}


def check_metadata(task):
    """nbgrader's metadata of a check (autograded test cell), with its protection.

    Parameters
    ----------
    task : slamlab.exercises.task.Task

    Returns
    -------
    dict
    """
    points = int(task.points) if float(task.points).is_integer() else float(task.points)
    graded = _nbgrader(task.id, grade=True, locked=True) | {"points": points}
    return {"nbgrader": graded, **PROTECTED}


def _nbgrader(id, grade=False, solution=False, locked=False):
    return {
        "schema_version": 3,
        "grade_id": id,
        "grade": grade,
        "solution": solution,
        "locked": locked,
        "task": False,
    }


def _inside_function(tree, first, last):
    touched = [
        (node, owner)
        for node, owner in _statements(tree, None)
        if node.lineno < last and node.end_lineno > first
    ]
    inside = [(n, owner) for n, owner in touched if n.lineno > first and n.end_lineno < last]
    if not inside:
        raise SolutionError(first, "an empty solution: nothing stands between the marks")
    if any(owner is None or owner.lineno > first for _, owner in inside[:1]):
        raise SolutionError(first, "a solution must stand inside a function")
    # what the region touches but does not hold must hold the region: no statement is cut
    for node, _ in touched:
        holds = node.lineno < first and node.end_lineno >= inside[-1][0].end_lineno
        if not holds and not (node.lineno > first and node.end_lineno < last):
            raise SolutionError(first, "the marks cut a statement in two")


def _statements(node, owner):
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.stmt):
            yield child, owner
        function = isinstance(child, ast.FunctionDef | ast.AsyncFunctionDef)
        yield from _statements(child, child if function else owner)
