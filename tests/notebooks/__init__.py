"""What the notebook tests share: the notebooks, and what stands in them."""

import nbformat

from course.derive import FOLDERS
from course.source import ROOT, sources

LESSONS = [path for path in sources() if path.parent.name == "lessons"]
EXERCISES = [path for path in sources() if path.parent.name == "exercises"]
NOTEBOOKS = sorted(
    ROOT / folder / f"{path.stem}.ipynb"
    for path in sources()
    for folder in FOLDERS[path.parent.name.removesuffix("s")]
)


def lesson(path):
    """The stored notebook of a lesson's source."""
    return load(ROOT / "notebooks" / f"{path.stem}.ipynb")


def load(path):
    """A stored notebook."""
    return nbformat.read(path, as_version=4)


def name(path):
    """How a test names a source or a notebook: the last folder and the stem."""
    return f"{path.parent.name}/{path.stem}"


def code_cells(notebook):
    """The code cells of a notebook."""
    return [cell for cell in notebook.cells if cell.cell_type == "code"]


def images(cell):
    """The outputs of a code cell that hold a picture."""
    return [
        output
        for output in cell.get("outputs", [])
        if any(mime.startswith("image/") for mime in output.get("data", {}))
    ]


def texts(output):
    """Every text of an output that a reader sees."""
    yield from (output[key] for key in ("text", "evalue") if key in output)
    yield from output.get("traceback", [])
    data = output.get("data", {})
    yield from (text for mime, text in data.items() if not mime.startswith("image/"))
