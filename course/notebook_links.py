"""Links between notebooks: a lesson, its exercise, and the next lesson."""

import re
from dataclasses import replace

from course.source import Cell, file_name, kind_folder, main_line, numbered, topic

_TITLE = re.compile(r"^# # (?:Exercise )?\d\d · (.+?)(?:: exercise)?$", re.MULTILINE)


def with_links(source, last):
    """Return the cells of a source with links to the previous and the next notebook.

    Parameters
    ----------
    source : Source
    last : list of Cell, to follow the source's own

    Returns
    -------
    list of Cell
    """
    cells = [*source.cells, *last]
    lesson, exercise, following = _neighbours(source.path)
    if source.kind == "exercise":
        top = "Lesson: ", lesson, "../notebooks/"
        back, on = ("Back to lesson ", *top[1:]), ("on to lesson ", following, "../notebooks/")
        if not _names(cells[0], top):
            cells[0] = _longer(cells[0], _line(top))
        line = _line(back) if any(_names(cell, on) for cell in cells) else _line(back, on)
        return [*cells, Cell("markdown", line, "ways", cells[-1].line, {})] if line else cells
    texts = [
        k for k, c in enumerate(main_line(cells)) if c.type == "markdown" and c.slide != "notes"
    ]
    place = texts[-1]
    links = ("Exercise ", exercise, "../exercises/"), ("On to lesson ", following, "")
    line = _line(*(link for link in links if not _names(cells[place], link)))
    cells[place] = _longer(cells[place], line)
    return cells


def _names(cell, link):
    """Whether a text contains a link already."""
    _, path, folder = link
    return path is not None and f"]({folder}{file_name(path)})" in cell.text


def _neighbours(path):
    """Return the sources of the lesson and exercise with this number, and of the next lesson."""
    number = topic(path).split("_")[0]
    root = kind_folder(path).parents[1]
    coming = f"{int(number) + 1:02}" if number.isdigit() else ""

    # after the last lesson: lesson 00, which has the map of the course
    following = numbered(coming, "lessons", root) or numbered("00", "lessons", root)
    return numbered(number, "lessons", root), numbered(number, "exercises", root), following


def _line(*links):
    """Format links to existing sources, each given as (words before it, source or None, folder)."""
    return " · ".join(words + _link(path, folder) for words, path, folder in links if path)


def _link(path, folder):
    title = _TITLE.search(path.read_text(encoding="utf-8"))
    name = title[1] if title else topic(path)
    return f"[{topic(path)[:2]} {name}]({folder}{file_name(path)})"


def _longer(cell, line):
    return replace(cell, text=f"{cell.text}\n\n{line}") if line else cell
