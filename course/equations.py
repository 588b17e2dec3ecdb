"""Equation numbers: ``\\tag{07.3}`` marks the third equation of lesson 07; ``(07.3)`` refers to
it."""

import re
from functools import cache

from course.source import ROOT

DISPLAY = re.compile(r"\$\$(.+?)\$\$", re.DOTALL)
TAG = re.compile(r"\\tag\{(\d\d\.\d+)\}")
REFERENCE = re.compile(r"\((\d\d\.\d+)\)")


def numbers(text):
    """List the numbers of a text's equations in order.

    Parameters
    ----------
    text : str

    Returns
    -------
    list of str, such as "07.3"
    """
    return TAG.findall(text)


@cache
def of_lesson(number, root=ROOT):
    """Return the numbers of a lesson's equations.

    Parameters
    ----------
    number : str, such as "07"
    root : Path, the project's folder

    Returns
    -------
    frozenset of str
    """
    paths = (root / "course" / "lessons").glob(f"{number}_*.py")
    return frozenset(each for path in paths for each in numbers(path.read_text("utf-8")))


def problems(source):
    """Find problems with equations: numbers out of order, missing numbers, dangling references.

    Parameters
    ----------
    source : course.source.Source

    Yields
    ------
    (Cell, str)
    """
    texts = [cell for cell in source.cells if cell.type == "markdown"]
    own = [each for cell in texts for each in numbers(cell.text)]
    wanted = iter(range(1, len(own) + 1))
    for cell in texts:
        for each in numbers(cell.text):
            if each != (right := f"{source.number}.{next(wanted)}"):
                yield cell, f"the equation ({each}) should be ({right})"
        bare = [shown for shown in DISPLAY.findall(cell.text) if not numbers(shown)]
        if own and bare:
            yield (
                cell,
                "an equation has no number: number all equations (\\tag) or none",
            )
        for each in REFERENCE.findall(cell.text):
            if each not in own and each not in of_lesson(each[:2]):
                yield cell, f"the equation ({each}) does not exist"
