"""Detect a syntax error in a function's last cell, which makes Python keep the old function."""

import ast
import re


def describe_syntax_error(functions, shell) -> str | None:
    """Describe a syntax error in the last cell that defines one of the functions, if any."""
    for name in functions if shell is not None else ():
        begins = re.compile(rf"^def {re.escape(name)}\b", re.MULTILINE)
        cells = (cell for cell in reversed(shell.user_ns.get("In", ())) if begins.search(cell))
        line = _syntax_error(next(cells, ""), shell)
        if line is not None:
            older = name in shell.user_ns
            used = "an older definition is checked" if older else "Python did not run the cell"
            return f"The last cell that defines {name} has a syntax error in line {line}: {used}."
    return None


def _syntax_error(cell, shell):
    try:
        ast.parse(shell.transform_cell(cell))
    except SyntaxError as error:
        return error.lineno or 1
    return None
