"""Shared by the notebook tests: paths and contents of the notebooks."""

import re

import nbformat

from course.derive import FOLDERS
from course.source import KINDS, ROOT, file_name, kind_folder, sources, topic

LESSONS = sources(folder="lessons")
EXERCISES = sources(folder="exercises")
APPENDICES = sources(folder="appendices")
NOTEBOOKS = sorted(
    ROOT / folder / file_name(path)
    for path in sources()
    for folder in FOLDERS[KINDS[kind_folder(path).name]]
)


def lesson(path):
    """The stored notebook of a lesson's source."""
    return load(ROOT / "notebooks" / f"{path.stem}.ipynb")


def load(path):
    """A stored notebook."""
    return nbformat.read(path, as_version=4)


def name(path):
    """How a test names a source or a notebook: the last folder and the stem."""
    return f"{kind_folder(path).name}/{topic(path)}"


def code_cells(notebook):
    """The code cells of a notebook."""
    return [cell for cell in notebook.cells if cell.cell_type == "code"]


def images(cell):
    """The pictures that a code cell's outputs hold, each its HTML element."""
    shown = (output.get("data", {}) for output in cell.get("outputs", []))
    bare = [mime for data in shown for mime in data if mime.startswith("image/")]
    assert bare == [], f"{cell.id}: a picture outside HTML has no alternative text on the page"
    htmls = (output.get("data", {}).get("text/html", "") for output in cell.get("outputs", []))
    return [picture for text in htmls for picture in re.findall(r"<img[^>]*>", text)]


def texts(output):
    """Every text of an output that a reader sees."""
    yield from (output[key] for key in ("text", "evalue") if key in output)
    yield from output.get("traceback", [])
    data = output.get("data", {})
    yield from (re.sub(r"data:image/[^\"]*", "", text) for text in data.values())
