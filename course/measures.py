"""Measures of the lessons, as a Markdown table: minutes, words, code, controls, questions, seconds.

    python -m course.measures          # what the sources say
    python -m course.measures --run    # and how long each runs, all cells one after the other

Seconds are honest only on a machine that does nothing else; they begin with the kernel's start.
"""

import argparse
import ast
import re
import sys
import time
from tempfile import TemporaryDirectory
from pathlib import Path

import nbformat

from course import visible_code
from course.execute import execute
from course.source import OPTIONAL, ROOT, read, sources
from slamlab.coursework.overview import QUESTION

HEAD = "lesson", "minutes", "words", "lines of code", "controls", "questions", "seconds"
NOT_CONTROLS = {"draw", "alt", "play"}  # what else ``explore`` is given
PLAYERS = {"live", "linked"}  # widgets that are a control in themselves
WORD = re.compile(r"[^\W\d_]{2,}")
UNREAD = re.compile(r"\$\$.*?\$\$|\$[^$]*\$|\]\([^)]*\)|\{=.*?=\}|`[^`]*`", re.DOTALL)


def main_line(source):
    """The cells that everybody reads: neither the lecturer's notes nor the optional sections.

    Parameters
    ----------
    source : Source of a lesson

    Returns
    -------
    list of Cell
    """
    begin = (n for n, cell in enumerate(source.cells) if cell.text.startswith(OPTIONAL))
    cells = source.cells[: next(begin, None)]
    return [cell for cell in cells if cell.slide != "notes"]


def words(cells):
    """Words of prose: without formulas, code, addresses and computed numbers; int."""
    prose = (UNREAD.sub(" ", cell.text) for cell in cells if cell.type == "markdown")
    return sum(len(WORD.findall(text)) for text in prose)


def controls(cells):
    """What there is to move: sliders, choices and tick boxes of ``explore``, and players; int."""
    count = 0
    for cell in cells:
        for node in ast.walk(ast.parse(cell.text)) if cell.type == "code" else ():
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
                given = {keyword.arg for keyword in node.keywords}
                count += len(given - NOT_CONTROLS) if node.func.attr == "explore" else 0
                count += node.func.attr in PLAYERS
    return count


def row(source, seconds=None):
    """One lesson's row of the table: tuple as HEAD says.

    Parameters
    ----------
    source : Source
    seconds : float or None, how long all of it ran
    """
    cells = main_line(source)
    code = [cell.text for cell in source.cells if cell.type == "code"]
    return (
        source.number,
        sum(cell.minutes or 0 for cell in cells),
        words(cells),
        sum(map(visible_code.lines, source.cells)),
        controls(source.cells),
        sum(len(QUESTION.findall(text)) for text in code),
        "–" if seconds is None else f"{seconds:.1f}",
    )


def seconds_of(source):
    """How long a lesson's stored notebook runs, all cells: float [s]."""
    notebook = nbformat.read(ROOT / "notebooks" / source.file, as_version=4)
    with TemporaryDirectory(dir=ROOT) as folder:
        start = time.perf_counter()
        execute(notebook, Path(folder))
        return time.perf_counter() - start


def main(argv=None):
    """Run the command line; returns its exit code."""
    parser = argparse.ArgumentParser(prog="python -m course.measures", description=__doc__)
    parser.add_argument("--run", action="store_true", help="run each lesson and time it")
    parser.add_argument("lessons", nargs="*", help="numbers, such as 04; by default all")
    options = parser.parse_args(argv)
    print("|", " | ".join(HEAD), "|\n" + "| --: " * len(HEAD) + "|")
    for path in sources():
        source = read(path)
        if source.kind != "lesson" or (options.lessons and source.number not in options.lessons):
            continue
        seconds = seconds_of(source) if options.run else None
        print("|", " | ".join(map(str, row(source, seconds))), "|", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
