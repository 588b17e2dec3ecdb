"""Large numbers in one form: 1000 together, from five digits on in groups of three, 10 000."""

import ast
import re

from course import values

# in names, times, fractions, addresses, behind a decimal point, or where code computes, it is none
TOGETHER = re.compile(r"(?<![\w.,/:#=^\\])(?<!\w[-(])(?<![-+^%*/<>] )(?<!\+= )\d{5,}(?![\w/:])")
OTHERWISE = re.compile(r"\d,\d{3}(?!\d)|(?<![\d .,])\d \d{3}(?![\d\w]| \d)")  # 10,000 and 1 000
CODE = re.compile(
    r"```.*?```|`[^`]*`|\]\([^)]*\)|<[^>]*>|\[[^\]]*\d, [^\]]*\]|\{'[^}]*\}", re.DOTALL
)
FORMAT = re.compile(r"[,_][\d.]*[defgn]?$")
# numbers that name something, and programs in words
NAMES = re.compile(r"--port is 0 to 65535|\(12345\)|360 for 36000")
SAYS = "write large numbers as 10 000, in formulas 10\\,000, and 1000 without a space"
FORMAT_SAYS = f"{SAYS}: grouped(number), of slamlab.displays and of views"


def in_prose(text):
    """Find the first large number of a text that is written in another form.

    Parameters
    ----------
    text : str, of Markdown; code, addresses, lists and dicts in it are not looked at

    Returns
    -------
    str or None
    """
    prose = NAMES.sub("", CODE.sub("", values.MARK.sub("", text)))
    found = OTHERWISE.search(prose) or TOGETHER.search(prose)
    if found is None:
        formats = (each for each in values.MARK.findall(text) if re.search(r":[,_]\w?$", each))
        return next(formats, None)
    return found[0]


def in_code(tree):
    """Find strings and formats of a program that show a large number in another form.

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
                yield node.lineno, FORMAT_SAYS
        text = getattr(node, "value", None) if isinstance(node, ast.Constant) else None
        if isinstance(text, str) and " " in text and (found := in_prose(text)):
            yield node.lineno, f"{found}: {SAYS}"
