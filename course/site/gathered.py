"""Pages gathered from sections of all lessons: what is misprinted in the sources, and what to read."""

import re

HEADS = {
    "errata": """\
# Errata

What the sources of this course print wrong, with what is right and what harm the slip does. Each table is that of
a lesson, where the mistakes are also found by machine.
""",
    "literature": """\
# Literature

What each lesson rests on, and what to read next.
""",
}
_SECTIONS = {"errata": "In print", "literature": "Literature"}
_HEADING = re.compile(r"^(#+) (.*)$", re.MULTILINE)
_TABLE = re.compile(r"^\|.*\n\|[ :|-]+\|\n(?:\|.*(?:\n|$))+", re.MULTILINE)


def page(kind, lessons):
    """The page, Markdown.

    Parameters
    ----------
    kind : str, "errata" or "literature"
    lessons : list of (str, str, NotebookNode), title, name of the page, what the site shows of it

    Returns
    -------
    str
    """
    parts = [HEADS[kind]]
    for title, name, notebook in lessons:
        text = section(notebook, _SECTIONS[kind])
        found = "\n\n".join(_TABLE.findall(text)) if kind == "errata" else text
        if found.strip():
            parts.append(f"## [{title}]({name})\n\n{found.strip()}\n".replace("](../", "]("))
    return "\n".join(parts)


def section(notebook, heading):
    """The text of a lesson's section, without the heading; empty where it has none.

    Parameters
    ----------
    notebook : NotebookNode
    heading : str, how it begins

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
