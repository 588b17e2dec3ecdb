"""Derive (generate) notebooks without outputs from a source; nothing is run or written."""

import re
from dataclasses import dataclass, replace
from pathlib import Path

import nbformat

from classroom.exercises import catalogue
from classroom.exercises.verdict_text import points
from course import glossary, question_cells, visible_code
from course.lint import lint
from course.notebook_links import with_links
from course.solution_cells import (
    PROTECTED,
    VALIDATE,
    check_metadata,
    solution_metadata,
    solution_regions,
    strip_solutions,
)
from course.source import ROOT, Cell, CourseError, Source, read

_TASK_HEADING = re.compile(r"^## .*\S", re.MULTILINE)
FOLDERS = {
    "lesson": ("notebooks",),
    "exercise": ("exercises", "solutions"),
    "appendix": ("notebooks",),
}


@dataclass(frozen=True)
class Derived:
    """A derived notebook of a source, without outputs.

    Parameters
    ----------
    source : Source
    path : Path, of the notebook
    notebook : NotebookNode
    runs : bool, whether it is stored with outputs
    """

    source: Source
    path: Path
    notebook: nbformat.NotebookNode
    runs: bool


def derive(path, root=ROOT):
    """Derive the notebooks of one source: one notebook of a lesson, or two of an exercise (to solve
    and solved).

    Parameters
    ----------
    path : Path, the source
    root : Path, the project's folder

    Returns
    -------
    list of Derived

    Raises
    ------
    CourseError : the source violates the course's standards
    """
    source = read(path)
    exercise = _exercise(source.number) if source.kind == "exercise" else None
    problems = lint(source, exercise)
    if problems:
        raise CourseError(problems)
    last = []
    if exercise:
        source = replace(source, cells=_with_points(source.cells, exercise))
        last = [Cell("code", VALIDATE, "validate", source.cells[-1].line, {})]
    source = replace(source, cells=with_links(source, last))
    return [
        Derived(
            source,
            root / folder / source.file,
            _notebook(source, exercise, stubs=folder == "exercises"),
            folder != "exercises",
        )
        for folder in FOLDERS[source.kind]
    ]


def _exercise(number):
    try:
        return catalogue.exercise(number)
    except KeyError:
        return None


def _with_points(cells, exercise):
    """Return the cells with each task's points added to the heading above its check."""
    found, headed = list(cells), None
    for k, cell in enumerate(cells):
        if cell.type == "markdown" and _TASK_HEADING.search(cell.text):
            headed = k
        elif cell.check and headed is not None:
            worth = f" · {points(exercise.task(cell.check).points)}"
            *_, heading = _TASK_HEADING.finditer(found[headed].text)
            text = found[headed].text
            text = text[: heading.end()] + worth + text[heading.end() :]
            found[headed], headed = replace(found[headed], text=text), None
    return found


def _notebook(source, exercise, stubs):
    notebook = nbformat.v4.new_notebook()
    notebook.metadata = nbformat.from_dict(
        {
            "kernelspec": {
                "display_name": "Python 3 (ipykernel)",
                "language": "python",
                "name": "python3",
            },
            "language_info": {
                "file_extension": ".py",
                "mimetype": "text/x-python",
                "name": "python",
                "pygments_lexer": "ipython3",
            },
            "slamlab": {source.kind: source.number},
        }
    )
    notebook.cells = [_cell(cell, exercise, stubs) for cell in source.cells]
    return notebook


def _cell(cell, exercise, stubs):
    metadata = {k: v for k, v in cell.metadata.items() if k in ("slideshow", "tags")}
    if cell.minutes:
        metadata |= {"slamlab": {"minutes": cell.minutes}}
    if cell.answers:  # folded until the question is answered
        answers = metadata.get("slamlab", {}) | {"answers": cell.answers}
        folded = "outputs_hidden" if cell.type == "code" else "source_hidden"
        metadata |= {"slamlab": answers, "jupyter": {folded: True}}
    if visible_code.FOLDED in cell.tags:
        metadata["jupyter"] = metadata.get("jupyter", {}) | {"source_hidden": True}
    text = glossary.filled(cell.text)
    if cell.check:
        metadata |= check_metadata(exercise.task(cell.check))
    elif cell.given is not None:
        metadata |= solution_metadata(cell.id)
        text = cell.given if stubs else text
    elif cell.type == "code" and solution_regions(text):
        metadata |= solution_metadata(cell.id)
        text = strip_solutions(text) if stubs else text
    elif cell.text == VALIDATE:
        metadata |= PROTECTED
    elif cell.type == "code":
        text = question_cells.short(text)
    if stubs and "nbval-check-output" in cell.tags:  # no stored output to compare with
        metadata["tags"] = [tag for tag in cell.tags if tag != "nbval-check-output"]
    if not metadata.get("tags", True):
        del metadata["tags"]
    new = nbformat.v4.new_code_cell if cell.type == "code" else nbformat.v4.new_markdown_cell
    return new(text, id=cell.id, metadata=nbformat.from_dict(metadata))
