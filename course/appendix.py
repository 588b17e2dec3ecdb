"""Appendix of the course, without code: what the sources print wrong, lesson by lesson."""

import re

import nbformat

from course.site import gathered
from course.source import ROOT

FILE = "notebooks/in_print.ipynb"
_BETWEEN_TABLES = re.compile(r"(?<=\|)\n{2,}(?=\|)")
_CLOSING = "\n\nThe way through the course: [Start here](00_start_here.ipynb)."


def notebook(root=ROOT):
    """The appendix as the stored lessons have it, which hold the computed numbers.

    Parameters
    ----------
    root : Path, the project's folder

    Returns
    -------
    NotebookNode
    """
    lessons = []
    for path in sorted((root / "notebooks").glob("[0-9][0-9]_*.ipynb")):
        lesson = nbformat.read(path, as_version=4)
        title = re.search(r"^# +(.+)$", lesson.cells[0].source, re.MULTILINE)[1]
        lessons.append((title, path.name, lesson))
    parts = re.split(r"(?m)^(?=## )", gathered.page("errata", lessons))
    parts[0] = parts[0].strip() + _CLOSING
    made = nbformat.v4.new_notebook()
    made.metadata["slamlab"] = {"appendix": "in print"}
    made.metadata["kernelspec"] = {"name": "python3", "display_name": "Python 3 (ipykernel)"}
    made.cells = [cell for k, part in enumerate(parts) for cell in _slides(part.strip(), k)]
    return made


def _slides(part, number):
    """A lesson's part as cells: a slide for each table, as the lesson itself has it."""
    return [
        nbformat.v4.new_markdown_cell(
            text,
            id=f"in-print-{number}" + (f"-{k}" if k else ""),
            metadata={"slideshow": {"slide_type": "subslide" if k else "slide"}},
        )
        for k, text in enumerate(_BETWEEN_TABLES.split(part))
    ]


def is_stored(root=ROOT):
    """bool, whether the stored appendix says what the stored lessons do."""
    return _holds(root / FILE, nbformat.writes(notebook(root)))


def store(root=ROOT):
    """Store the appendix.

    Parameters
    ----------
    root : Path, the project's folder

    Returns
    -------
    str, what was done
    """
    text = nbformat.writes(notebook(root))
    if _holds(root / FILE, text):
        return f"{FILE} unchanged"
    (root / FILE).write_text(text, encoding="utf-8", newline="\n")
    return f"{FILE} written"


def _holds(file, text):
    return file.exists() and file.read_text(encoding="utf-8") == text
