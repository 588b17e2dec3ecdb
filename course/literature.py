"""Page that collects the section "Literature" of all lessons."""

import re

_HEAD = """\
# Literature

The sources of each lesson, and further reading.
"""
_HEADING = re.compile(r"^(#+) (.*)$", re.MULTILINE)


def page(lessons):
    """Create the page in Markdown.

    Parameters
    ----------
    lessons : list of (str, str, NotebookNode), title, name of the page, the lesson as shown

    Returns
    -------
    str
    """
    parts = [_HEAD]
    for title, name, notebook in lessons:
        if text := section(notebook, "Literature").strip():
            parts.append(f"## [{title}]({name})\n\n{text}\n".replace("](../", "]("))
    return "\n".join(parts)


def section(notebook, heading):
    """Return the text of a lesson's section without its heading, or "" if the section is missing.

    Parameters
    ----------
    notebook : NotebookNode
    heading : str, its beginning

    Returns
    -------
    str
    """
    found, inside = [], False
    for cell in notebook.cells:
        if cell.cell_type != "markdown":
            continue
        begins = _HEADING.match(cell.source)
        if begins and len(begins[1]) <= 2:
            inside = begins[2].startswith(heading)
        if inside:
            found.append(_HEADING.sub("", cell.source, count=1) if begins else cell.source)
    return "\n\n".join(text.strip() for text in found)
