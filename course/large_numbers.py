"""Linter for the format of large numbers: 1000 without a space, 10 000 with a space."""

import ast
import re

from course import computed_values

# digits in names, times, fractions, addresses, decimals and computed code are not such numbers
TOGETHER = re.compile(r"(?<![\w.,/:#=^\\@])(?<!\w[-(])(?<![-+^%*/<>] )(?<!\+= )\d{5,}(?![\w/:])")
OTHERWISE = re.compile(r"\d,\d{3}(?!\d)|(?<![\d .,])\d \d{3}(?![\d\w]| \d)")  # 10,000 and 1 000
CODE = re.compile(
    r"```.*?```|`[^`]*`|\]\([^)]*\)|<[^>]*>|\[[^\]]*\d, [^\]]*\]|\{'[^}]*\}", re.DOTALL
)
FORMAT = re.compile(r"[,_][\d.]*[defgn]?$")
# numbers that are names, and program texts
NAMES = re.compile(r"--port must be from 0 to 65535|\(12345\)|360 for 36000")
MESSAGE = "write large numbers as 10 000, in formulas 10\\,000, and 1000 without a space"
FORMAT_MESSAGE = f"{MESSAGE}: use grouped(number), from slamlab.views.notebook_output or views"


def in_prose(text):
    """Find the first large number in a text that has a wrong format.

    Parameters
    ----------
    text : str, of Markdown; code, addresses, lists and dicts in it are ignored

    Returns
    -------
    str or None
    """
    prose = NAMES.sub("", CODE.sub("", computed_values.MARK.sub("", text)))
    found = OTHERWISE.search(prose) or TOGETHER.search(prose)
    if found is None:
        formats = (
            each for each in computed_values.MARK.findall(text) if re.search(r":[,_]\w?$", each)
        )
        return next(formats, None)
    return found[0]


def in_code(tree):
    """Find strings and format specifications in a program that show a large number in a wrong
    format.

    Parameters
    ----------
    tree : ast.Module

    Yields
    ------
    (line, text)
    """
    for node in ast.walk(tree):
        if isinstance(node, ast.FormattedValue) and node.format_spec is not None:
            last = node.format_spec.values[-1]
            if isinstance(last, ast.Constant) and FORMAT.search(last.value):
                yield node.lineno, FORMAT_MESSAGE
        text = getattr(node, "value", None) if isinstance(node, ast.Constant) else None
        if isinstance(text, str) and " " in text and (found := in_prose(text)):
            yield node.lineno, f"{found}: {MESSAGE}"
