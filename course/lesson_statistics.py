"""Statistics of the lessons as a Markdown table: minutes, words, code, controls, questions, run
time.

    python -m course.lesson_statistics          # from the sources alone
    python -m course.lesson_statistics --run    # also run each lesson and time it

Run times include the kernel's start. Measure run times on an otherwise idle machine.
"""

import argparse
import ast
import re
import sys
import time
from pathlib import Path
from tempfile import TemporaryDirectory

import nbformat

from classroom.coursework.progress_overview import QUESTION
from course import visible_code
from course.execute import execute
from course.source import OPTIONAL, ROOT, read, sources

HEAD = "lesson", "minutes", "words", "lines of code", "controls", "questions", "seconds"
NOT_CONTROLS = {"draw", "alt", "play"}  # other arguments of ``explore``
PLAYERS = {"watch", "linked"}  # widgets that are a control in themselves
WORD = re.compile(r"[^\W\d_]{2,}")
UNREAD = re.compile(r"\$\$.*?\$\$|\$[^$]*\$|\]\([^)]*\)|\{=.*?=\}|`[^`]*`", re.DOTALL)


def main_line(source):
    """Return the cells that all readers see, without lecturer's notes and optional sections.

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
    """Count the words of prose, without formulas, code, addresses and computed numbers."""
    prose = (UNREAD.sub(" ", cell.text) for cell in cells if cell.type == "markdown")
    return sum(len(WORD.findall(text)) for text in prose)


def controls(cells):
    """Count the controls: the sliders, menus and check boxes of ``explore``, and the players."""
    count = 0
    for cell in cells:
        for node in ast.walk(ast.parse(cell.text)) if cell.type == "code" else ():
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
                given = {keyword.arg for keyword in node.keywords}
                count += len(given - NOT_CONTROLS) if node.func.attr == "explore" else 0
                count += node.func.attr in PLAYERS
    return count


def row(source, seconds=None):
    """Create one lesson's row of the table: a tuple with the columns of HEAD.

    Parameters
    ----------
    source : Source
    seconds : float or None, run time of all cells
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
    """Measure the run time of all cells of a lesson's stored notebook [s]."""
    notebook = nbformat.read(ROOT / "notebooks" / source.file, as_version=4)
    with TemporaryDirectory(dir=ROOT) as folder:
        start = time.perf_counter()
        execute(notebook, Path(folder))
        return time.perf_counter() - start


def main(argv=None):
    """Run the command line and return its exit code."""
    parser = argparse.ArgumentParser(prog="python -m course.lesson_statistics", description=__doc__)
    parser.add_argument("--run", action="store_true", help="run each lesson and measure the time")
    parser.add_argument("lessons", nargs="*", help="lesson numbers, such as 04 (default: all)")
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
