"""Links from notebook to notebook: lesson, its exercise, the next lesson; no notebook is an end."""

import re
from dataclasses import replace

from course.source import Cell, file_name, main_line

_TITLE = re.compile(r"^# # (?:Exercise )?\d\d · (.+?)(?:: exercise)?$", re.MULTILINE)


def with_links(source, last):
    """The cells of a source with links to what comes before and after it.

    Parameters
    ----------
    source : Source
    last : list of Cell, to stand behind the source's own

    Returns
    -------
    list of Cell
    """
    cells = [*source.cells, *last]
    lesson, exercise, following = _neighbours(source.path)
    if source.kind == "exercise":
        cells[0] = _longer(cells[0], _line(("Lesson: ", lesson, "../notebooks/")))
        line = _line(
            ("Back to lesson ", lesson, "../notebooks/"),
            ("on to lesson ", following, "../notebooks/"),
        )
        return [*cells, Cell("markdown", line, "ways", cells[-1].line, {})] if line else cells
    line = _line(("Exercise ", exercise, "../exercises/"), ("on to lesson ", following, ""))
    place = [k for k, cell in enumerate(main_line(cells)) if cell.type == "markdown"][-1]
    cells[place] = _longer(cells[place], line)
    return cells


def _neighbours(path):
    """The sources of this number's lesson and exercise, and of the lesson to go on to."""
    course, number = path.parent.parent, path.stem.split("_")[0]
    coming = f"{int(number) + 1:02}" if number.isdigit() else ""

    def one(kind, id):
        return next(iter(sorted((course / kind).glob(f"{id}_*.py"))), None) if id else None

    # behind the last lesson the map of the course: lesson 00
    following = one("lessons", coming) or one("lessons", "00")
    return one("lessons", number), one("exercises", number), following


def _line(*links):
    """Links to the sources that there are, each (words before it, source or None, folder)."""
    return " · ".join(words + _link(path, folder) for words, path, folder in links if path)


def _link(path, folder):
    title = _TITLE.search(path.read_text(encoding="utf-8"))
    name = title[1] if title else path.stem
    return f"[{path.stem[:2]} {name}]({folder}{file_name(path)})"


def _longer(cell, line):
    return replace(cell, text=f"{cell.text}\n\n{line}") if line else cell
