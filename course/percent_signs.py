"""Linter for per cent signs: a space must precede the sign, in prose and in the output of code."""

import ast
import re
from itertools import pairwise

NO_SPACE = re.compile(r"\d%")
FORMATTED = re.compile(r"\{[^{}]*%\}")  # by str.format, as in "{:.0%}"
STYLE = re.compile(r"\d+%|.*(?:size|width): \d+%.*", re.DOTALL)  # a length of CSS
MESSAGE = "write a space before %, as in 38 %"
FORMAT_MESSAGE = f'{MESSAGE}: write f"{{100 * share:.0f}} %"'


def in_prose(text):
    """Return whether a text contains a number followed by % without a space.

    Parameters
    ----------
    text : str

    Returns
    -------
    bool
    """
    return bool(NO_SPACE.search(text))


def in_code(tree):
    """Find strings in a program that show a number followed by % without a space.

    Parameters
    ----------
    tree : ast.Module

    Yields
    ------
    (line, text)
    """
    nodes = list(ast.walk(tree))
    specs = [node.format_spec for node in nodes if isinstance(node, ast.FormattedValue)]
    in_specs = {part for spec in filter(None, specs) for part in ast.walk(spec)}
    for node in nodes:
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and node not in in_specs:
            if FORMATTED.search(node.value):
                yield node.lineno, FORMAT_MESSAGE
            elif NO_SPACE.search(node.value) and not STYLE.fullmatch(node.value):
                yield node.lineno, MESSAGE
        elif isinstance(node, ast.FormattedValue) and _ends_in_per_cent(node.format_spec):
            yield node.lineno, FORMAT_MESSAGE
        elif isinstance(node, ast.JoinedStr) and node not in in_specs:
            for value, behind in pairwise(node.values):
                if isinstance(value, ast.FormattedValue) and _begins_with_per_cent(behind):
                    yield node.lineno, MESSAGE


def _ends_in_per_cent(spec):
    last = spec.values[-1] if spec is not None and spec.values else None
    return isinstance(last, ast.Constant) and last.value.endswith("%")


def _begins_with_per_cent(part):
    return isinstance(part, ast.Constant) and part.value.startswith("%")
