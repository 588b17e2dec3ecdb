"""Linter for figures in the course's sources: it finds hard-coded colours and numbers."""

import ast
import inspect
import re

from matplotlib.colors import CSS4_COLORS

from slamlab import live, views

COLOUR_ARGUMENT = re.compile(r"c|[ef]c|m[ef]c|.*colou?rs?")
CODED = re.compile(r"#[0-9a-fA-F]{3,8}|C\d+|(tab|xkcd):.+")
# a format string of matplotlib that names a colour, such as "k--" or "r."
FORMAT = re.compile(r"[-.:,ov^<>spP*hHxXDd|_+\d]*[bgrcmykw][-.:,ov^<>spP*hHxXDd|_+\d]*")
PLOTS = {"errorbar", "loglog", "plot", "semilogx", "semilogy", "step", "stem"}

# digits that an alternative text may contain without data, each with its reason
NUMBERS = {
    r"\bsituation[ -]\d\b": "the name of one of the two thesis worlds",
}


def figure_problems(tree):
    """Find hard-coded colours and numbers, which must come from the colour table or the data.

    Parameters
    ----------
    tree : ast.Module of a cell

    Yields
    ------
    (line in the cell, text)
    """
    for node in ast.walk(tree):
        for line, colour in _typed_colours(node):
            yield (
                line,
                f'the colour {colour} is hard-coded: take it from views.COLOURS["meaning"] (or '
                "views.SERIES if it has no meaning)",
            )
        if isinstance(node, ast.Call):
            for line, number in _typed_numbers(node):
                yield (
                    line,
                    f"the alternative text has the hard-coded number {number!r}: insert it from "
                    'the data, f"… {value:.1f} …"',
                )


def _typed_colours(node):
    """Yield the hard-coded colours of a node as (line, program text)."""
    text = getattr(node, "value", None) if isinstance(node, ast.Constant) else None
    if isinstance(text, str) and (text.lower() in CSS4_COLORS or CODED.fullmatch(text)):
        yield node.lineno, repr(text)
    if isinstance(node, ast.JoinedStr):
        start = node.values[0] if node.values else None
        if isinstance(start, ast.Constant) and start.value in ("C", "#", "tab:"):
            yield node.lineno, ast.unparse(node)
    if isinstance(node, ast.Call):
        given = [(word.arg or "", word.value) for word in node.keywords]
        called = getattr(node.func, "attr", "")
        for value in node.args if called in PLOTS else ():
            if isinstance(value, ast.Constant) and FORMAT.fullmatch(str(value.value)):
                yield value.lineno, repr(value.value)
    elif isinstance(node, ast.Dict):
        given = [
            (getattr(key, "value", ""), of) for key, of in zip(node.keys, node.values, strict=True)
        ]
    else:
        return
    for name, value in given:
        if COLOUR_ARGUMENT.fullmatch(str(name)) and _is_short(value):
            yield value.lineno, ast.unparse(value)


def _is_short(value):
    """Return whether matplotlib reads a value as a colour: a letter, a grey level or a tuple."""
    if isinstance(value, ast.Tuple | ast.List):
        return bool(value.elts) and all(isinstance(each, ast.Constant) for each in value.elts)
    return isinstance(value, ast.Constant) and bool(
        re.fullmatch(r"[bgrcmykw]|[\d.]+", str(value.value))
    )


def _typed_numbers(call):
    """Yield the hard-coded numbers in the alternative text of a call to a view."""
    for text in _alternative_texts(call):
        formats = {
            id(part)
            for each in ast.walk(text)
            if isinstance(each, ast.FormattedValue)
            for part in ast.walk(each)
        }
        for part in ast.walk(text):
            if id(part) in formats or not isinstance(part, ast.Constant):
                continue
            left = re.sub("|".join(NUMBERS), "", str(part.value))
            if isinstance(part.value, str) and (found := re.search(r"\d[\d.,/]*", left)):
                yield part.lineno, found.group()


def _alternative_texts(call):
    yield from (word.value for word in call.keywords if word.arg == "alt")
    name = getattr(call.func, "attr", "")
    function = getattr(views, name, None) or getattr(live, name, None)
    if not callable(function):
        return
    names = list(inspect.signature(function).parameters)
    if "alt" in names and names.index("alt") < len(call.args):
        yield call.args[names.index("alt")]
