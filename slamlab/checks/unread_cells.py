"""Cells that Python could not read: what they define is not there, and an older function may be."""

import ast
import re


def unread(functions, shell) -> str | None:
    """Say that the last cell that defines a function has a syntax error: an older one is judged.

    Parameters
    ----------
    functions : names of a task's functions
    shell : IPython's shell, or None outside of a notebook

    Returns
    -------
    str, a sentence; None where all that was defined last was read
    """
    for name in functions if shell is not None else ():
        begins = re.compile(rf"^def {re.escape(name)}\b", re.MULTILINE)
        cells = (cell for cell in reversed(shell.user_ns.get("In", ())) if begins.search(cell))
        line = _syntax_error(next(cells, ""), shell)
        if line is not None:
            older = name in shell.user_ns
            follows = "what is judged is the one before it" if older else "Python read none of it"
            said = f"The last cell that defines {name} has a syntax error in its line {line}"
            return f"{said}: {follows}."
    return None


def _syntax_error(cell, shell):
    """The line of a cell's syntax error; None where it has none."""
    try:
        ast.parse(shell.transform_cell(cell))
    except SyntaxError as error:
        return error.lineno or 1
    return None
