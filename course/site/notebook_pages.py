"""Convert a notebook to a page: omit notes, make questions expandable, adapt links."""

import copy
import re

from course.question_cells import asks
from course.site.rendered_outputs import STILL, add_note, with_moving
from course.site.static_questions import question

NOTE = "notes"
PLACEHOLDER = re.compile(r"Run this cell [^.]*\.")  # placeholder of a widget
FOLDED = "<details>\n<summary>What this shows</summary>\n\n{}\n\n</details>"
_LINK = re.compile(r"\]\((?:\.\./)?(?:(notebooks|exercises)/)?([a-z0-9]\w+)\.ipynb(#[^)]+)?\)")
_WITHIN = re.compile(r"\]\((#[^)]+)\)")
_LESSON = re.compile(r"(?<!\[)\b([Ll]essons?) (\d\d)\b(?![^\[]*\])(?! ?[:·])")
_GUIDE = re.compile(r"\]\(\.\./docs/(\w+)\.md")
_BESIDE = re.compile(r"(?<!!)\[([^\]]+)\]\(\.\./(?:exercises/|guides/)[^)]*\)")
_H1 = re.compile(r"^# (?=\S)", re.MULTILINE)


def page(notebook, files, moving=None, folder=""):
    """Convert a notebook to the version that the site shows.

    Parameters
    ----------
    notebook : NotebookNode, not changed
    files : dict, number of a lesson to the name of its notebook without suffix
    moving : dict, renderings by the cell's id (:mod:`course.site.rendering`), or None
    folder : str, name of the folder of those files

    Returns
    -------
    NotebookNode
    """
    shown = copy.deepcopy(notebook)
    shown.metadata.pop("slamlab", None)
    shown.cells = [cell for cell in shown.cells if not _is_for_lecturers(cell)]
    for k, cell in enumerate(shown.cells):
        if cell.cell_type == "markdown":
            cell.source = _linked(cell.source if k == 0 else _demoted(cell.source), files)
            if _answers(cell):
                cell.source = FOLDED.format(cell.source)
        elif found := question(cell.source):
            shown.cells[k] = found.as_cell(cell.id)
        else:
            has_controls = _tidy(cell)
            if rendered := (moving or {}).get(cell.id):
                with_moving(cell, rendered, folder)
            elif has_controls:
                add_note(cell, STILL)
            if asks(cell.source):  # the code contains the answer
                cell.metadata.tags.append("remove-input")
    return shown


def without_links(notebook):
    """Replace links to exercises and guides by their text, for a site without these pages.

    Parameters
    ----------
    notebook : NotebookNode, changed
    """
    for cell in notebook.cells:
        if cell.cell_type == "markdown":
            cell.source = _BESIDE.sub(r"\1", cell.source)


def _is_for_lecturers(cell):
    metadata = cell.metadata
    is_note = metadata.get("slideshow", {}).get("slide_type") == NOTE
    return is_note or "lecturer" in metadata.get("tags", [])


def _demoted(text):
    """Demote headings of the first level: a page has only one, its title."""
    return _H1.sub("## ", text)


def _linked(text, files):
    """Convert links to notebooks to links to pages, and link lessons that are named by number."""

    def to_page(found):
        kind, name, part = found.groups()
        kind = kind or ("exercises" if re.match(r"ex\d", name) else "notebooks")
        return f"](../{kind}/{name}.ipynb{_anchor(part or '')})"

    def to_lesson(found):
        word, number = found.groups()
        name = files.get(number)
        return f"[{word} {number}](../notebooks/{name}.ipynb)" if name else found[0]

    text = _WITHIN.sub(lambda found: f"]({_anchor(found[1])})", text)
    lines = [
        line if line.startswith(("#", "    ")) else _LESSON.sub(to_lesson, line)
        for line in _GUIDE.sub(r"](../guides/\1.md", _LINK.sub(to_page, text)).split("\n")
    ]
    return "\n".join(lines)


def _anchor(part):
    """Convert JupyterLab's anchor (#Appendix:-words) to the site's (#appendix-words)."""
    return re.sub(r"[^\w#-]", "", part.lower())


def _tidy(cell):
    """Fold an answer, drop a widget's placeholder, and return whether the cell has controls."""
    tags = cell.metadata.setdefault("tags", [])
    if _answers(cell):
        tags.append("hide-cell")
    widgets = [output for output in cell.outputs if _is_placeholder(output)]
    cell.outputs = [output for output in cell.outputs if output not in widgets]
    return any("its controls" in output.data.get("text/plain", "") for output in widgets)


def _answers(cell):
    """Whether a cell answers a question and is folded until the reader answers it."""
    return "answers" in cell.metadata.get("slamlab", {})


def _is_placeholder(output):
    data = output.get("data", {})
    empty = not any(text for text in data.values())
    words = data.get("text/plain", "")
    alone = "data" in output and set(data) == {"text/plain"}
    return ("data" in output and empty) or bool(alone and PLACEHOLDER.fullmatch(words))
