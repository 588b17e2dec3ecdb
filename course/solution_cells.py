"""Solution cells of exercises: replacing solutions with stubs and adding nbgrader's metadata."""

import ast

BEGIN, END = "### BEGIN SOLUTION", "### END SOLUTION"
STUB = 'raise NotImplementedError("your code here")'
PROTECTED = {"deletable": False, "editable": False}
VALIDATE = """\
# Save first: this runs the saved file from top to bottom, as the grader will.
from classroom.checks import validate

validate()"""
"""The last cell of every exercise."""


class SolutionError(Exception):
    """The marks around a solution are wrong; ``line`` is the line number in the cell, from 1."""

    def __init__(self, line, message):
        super().__init__(message)
        self.line, self.message = line, message


def solution_regions(text):
    """Find a cell's solutions and check that their marks are balanced and enclose whole statements
    of one function.

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
            raise SolutionError(number, f"write the marks exactly as {BEGIN} and {END}")
    if begin:
        raise SolutionError(begin, f"{BEGIN} without {END}")
    if found:
        tree = ast.parse(text)
        for first, last in found:
            _inside_function(tree, first, last)
    return found


def strip_solutions(text):
    """Replace every solution in a cell with a stub; indentation and docstrings stay unchanged.

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
            error.lineno or 1, "without its solution the cell is not valid Python"
        ) from None
    return stripped


def solution_lines(text):
    """List the lines of code inside solutions, without indentation.

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
    """Return nbgrader's metadata of a solution cell, which cannot be deleted."""
    return {"nbgrader": _nbgrader(id, solution=True), "deletable": False}


def check_metadata(task):
    """Return nbgrader's metadata of a check (autograded test cell), which cannot be edited.

    Parameters
    ----------
    task : classroom.exercises.task.Task

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
        raise SolutionError(first, "the solution is empty: write code between the marks")
    if any(owner is None or owner.lineno > first for _, owner in inside[:1]):
        raise SolutionError(first, "a solution must be inside a function")
    # a statement that overlaps the region must contain it or be inside: none may be cut
    for node, _ in touched:
        holds = node.lineno < first and node.end_lineno >= inside[-1][0].end_lineno
        if not holds and not (node.lineno > first and node.end_lineno < last):
            raise SolutionError(first, "the marks split a statement")


def _statements(node, owner):
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.stmt):
            yield child, owner
        function = isinstance(child, ast.FunctionDef | ast.AsyncFunctionDef)
        yield from _statements(child, child if function else owner)
