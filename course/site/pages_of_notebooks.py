"""A notebook as the site shows it: no lecturer's notes, questions to unfold, links to pages."""

import copy
import re

from course.site.moving_outputs import STILL, tell, with_moving
from course.asking import asks
from course.site.questions import question

NOTE = "notes"
PLACEHOLDER = re.compile(r"Run this cell [^.]*\.")  # words in place of a widget
FOLDED = "<details>\n<summary>What this shows</summary>\n\n{}\n\n</details>"
_LINK = re.compile(r"\]\((?:\.\./)?(?:(notebooks|exercises)/)?((?:ex)?\d\d_\w+)\.ipynb(#[^)]+)?\)")
_WITHIN = re.compile(r"\]\((#[^)]+)\)")
_LESSON = re.compile(r"(?<!\[)\b([Ll]essons?) (\d\d)\b(?![^\[]*\])(?! ?[:·])")
_GUIDE = re.compile(r"\]\(\.\./docs/(\w+)\.md")
_APPENDIX = "](in_print.ipynb)"  # the site has a page of its own for it
_BESIDE = re.compile(r"(?<!!)\[([^\]]+)\]\(\.\./(?:exercises/|guides/|errata\b)[^)]*\)")
_H1 = re.compile(r"^# (?=\S)", re.MULTILINE)


def page(notebook, files, moving=None, folder=""):
    """The notebook that the site shows in place of one.

    Parameters
    ----------
    notebook : NotebookNode, left as it is
    files : dict, number of a lesson to the name of its notebook without suffix
    moving : dict, by a cell's id what was rendered of it (:mod:`course.site.rendering`), or None
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
            if told := (moving or {}).get(cell.id):
                with_moving(cell, told, folder)
            elif has_controls:
                tell(cell, STILL)
            if asks(cell.source):  # the code tells the answer
                cell.metadata.tags.append("remove-input")
    return shown


def without_links(notebook):
    """Make names of a page's links to exercises and guides, where there are no pages of these.

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
    """A page has one heading of the first level: its title."""
    return _H1.sub("## ", text)


def _linked(text, files):
    """Links to notebooks lead to pages; a lesson named by its number is a link."""

    def to_page(found):
        kind, name, part = found.groups()
        kind = kind or ("exercises" if name.startswith("ex") else "notebooks")
        return f"](../{kind}/{name}.ipynb{_anchor(part or '')})"

    def to_lesson(found):
        word, number = found.groups()
        name = files.get(number)
        return f"[{word} {number}](../notebooks/{name}.ipynb)" if name else found[0]

    text = _WITHIN.sub(lambda found: f"]({_anchor(found[1])})", text)
    text = text.replace(_APPENDIX, "](../errata.md)")
    lines = [
        line if line.startswith(("#", "    ")) else _LESSON.sub(to_lesson, line)
        for line in _GUIDE.sub(r"](../guides/\1.md", _LINK.sub(to_page, text)).split("\n")
    ]
    return "\n".join(lines)


def _anchor(part):
    """JupyterLab's name of a heading (#Appendix:-words) as the site's (#appendix-words)."""
    return re.sub(r"[^\w#-]", "", part.lower())


def _tidy(cell):
    """Fold what answers a question; drop the words in a widget's place, and tell if that has controls."""
    tags = cell.metadata.setdefault("tags", [])
    if _answers(cell):
        tags.append("hide-cell")
    widgets = [output for output in cell.outputs if _is_placeholder(output)]
    cell.outputs = [output for output in cell.outputs if output not in widgets]
    return any("its controls" in output.data.get("text/plain", "") for output in widgets)


def _answers(cell):
    """Whether a cell answers a question: it is folded until that is answered."""
    return "answers" in cell.metadata.get("slamlab", {})


def _is_placeholder(output):
    data = output.get("data", {})
    empty = not any(text for text in data.values())
    words = data.get("text/plain", "")
    alone = "data" in output and set(data) == {"text/plain"}
    return ("data" in output and empty) or bool(alone and PLACEHOLDER.fullmatch(words))
