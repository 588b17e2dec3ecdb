"""Cells for the lecturer (notes and tagged cells), which are removed from students' notebooks."""

import json

from classroom.coursework.file_writing import json_bytes

LECTURER = {"notes", "lecturer"}  # slide type or tag of cells that students do not get


def without_notes(data):
    """Return a notebook without the cells for the lecturer.

    Parameters
    ----------
    data : bytes, of a notebook's file

    Returns
    -------
    bytes
    """
    notebook = json.loads(data)
    notebook["cells"] = [cell for cell in notebook["cells"] if not LECTURER & marks(cell)]
    return json_bytes(notebook)


def marks(cell):
    """Return a cell's slide type and tags as a set."""
    metadata = cell["metadata"]
    return {metadata.get("slideshow", {}).get("slide_type"), *metadata.get("tags", [])}
