"""Linter of figures in the course's sources: colours by their meaning, numbers from the data."""

import ast
import inspect
import re

from matplotlib.colors import CSS4_COLORS

from slamlab import views

COLOUR_ARGUMENT = re.compile(r"c|[ef]c|m[ef]c|.*colou?rs?")
CODED = re.compile(r"#[0-9a-fA-F]{3,8}|C\d+|(tab|xkcd):.+")
# a format string of matplotlib that names a colour, such as "k--" or "r."
FORMAT = re.compile(r"[-.:,ov^<>spP*hHxXDd|_+\d]*[bgrcmykw][-.:,ov^<>spP*hHxXDd|_+\d]*")
PLOTS = {"errorbar", "loglog", "plot", "semilogx", "semilogy", "step", "stem"}

# digits that an alternative text may hold though no data bear them out, each with its reason
NUMBERS = {
    r"\bsituation[ -]\d\b": "the name of one of the two thesis worlds",
}


def figure_problems(tree):
    """Find colours and numbers that are typed where the table or the data would say them.

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
                f'the colour {colour} is typed: take it from views.COLOURS["meaning"] (or '
                "views.SERIES where it has none)",
            )
        if isinstance(node, ast.Call):
            for line, number in _typed_numbers(node):
                yield (
                    line,
                    f"the alternative text says {number!r} by itself: put it in from the data, "
                    'f"… {value:.1f} …"',
                )


def _typed_colours(node):
    """Colours that a node of a program names itself, as (line, program text)."""
    said = getattr(node, "value", None) if isinstance(node, ast.Constant) else None
    if isinstance(said, str) and (said.lower() in CSS4_COLORS or CODED.fullmatch(said)):
        yield node.lineno, repr(said)
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
    """Whether a value is a letter, a grey or three numbers that matplotlib takes for a colour."""
    if isinstance(value, ast.Tuple | ast.List):
        return bool(value.elts) and all(isinstance(each, ast.Constant) for each in value.elts)
    return isinstance(value, ast.Constant) and bool(
        re.fullmatch(r"[bgrcmykw]|[\d.]+", str(value.value))
    )


def _typed_numbers(call):
    """Typed numbers in the alternative text of a call to one of the views."""
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
    function = getattr(views, getattr(call.func, "attr", ""), None)
    if not callable(function):
        return
    names = list(inspect.signature(function).parameters)
    if "alt" in names and names.index("alt") < len(call.args):
        yield call.args[names.index("alt")]
