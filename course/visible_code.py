"""Visible code of a lesson: what is to be read is short, imports and drawings are folded."""

from slamlab.coursework.overview import QUESTION

MOST = 250  # lines of a lesson that a reader sees without opening anything
MOST_IN_A_CELL = 12  # lines, unless the code is the subject
FOLDED, SUBJECT = "folded", "code"  # tags


def lines(cell):
    """Number of lines of code that a reader sees: not those of questions, blank ones, comments.

    Parameters
    ----------
    cell : course.source.Cell

    Returns
    -------
    int
    """
    if cell.type != "code" or FOLDED in cell.tags or QUESTION.search(cell.text):
        return 0
    stripped = (line.strip() for line in cell.text.splitlines())
    return sum(bool(line) and not line.startswith("#") for line in stripped)


def problems(source):
    """Problems of a lesson with too much code to read, as (cell, text)."""
    for cell in source.cells:
        if lines(cell) > MOST_IN_A_CELL and SUBJECT not in cell.tags:
            yield (
                cell,
                f"{lines(cell)} lines of code to read, at most {MOST_IN_A_CELL}: split it; tag it "
                f"{FOLDED!r} where nobody needs to read it, {SUBJECT!r} where it is the subject",
            )
    total = sum(map(lines, source.cells))
    if total > MOST:
        yield source.cells[0], f"{total} lines of code to read in the lesson, at most {MOST}"
