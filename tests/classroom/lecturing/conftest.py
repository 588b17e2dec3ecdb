"""A lesson of a few cells."""

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

from tests.course.browser.jupyter import EXTENSION


def slide(kind, minutes=None):
    """A cell's metadata."""
    plan = {"slamlab": {"minutes": minutes}} if minutes else {}
    return {"slideshow": {"slide_type": kind}} | plan


@pytest.fixture
def write(tmp_path, monkeypatch):
    """Writes a lesson: its file."""
    monkeypatch.setenv("JUPYTER_PATH", str(EXTENSION))

    def written(code="print('done')", text="## Second", name="99_tiny.ipynb"):
        cells = [
            new_markdown_cell("# Tiny\n\n**7 minutes**", metadata=slide("slide", 2)),
            new_markdown_cell("Ask first.", metadata=slide("notes")),
            new_code_cell("import time", metadata=slide("skip")),
            new_markdown_cell(text, metadata=slide("slide", 5)),
            new_code_cell(code, id="the-cell", metadata=slide("fragment")),
        ]
        nbformat.write(new_notebook(cells=cells), tmp_path / name)
        return tmp_path / name

    return written
