"""Linter for the amount of visible code in a lesson; imports and plotting code are folded."""

from classroom.coursework.progress_overview import QUESTION

MOST = 250  # lines of a lesson that a reader sees without opening anything
MOST_IN_A_CELL = 12  # lines, unless the code is the subject
FOLDED, SUBJECT = "folded", "code"  # tags


def lines(cell):
    """Count the lines of code that a reader sees, except for questions, blank lines and comments.

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
    """Yield (cell, text) for each place with too much visible code in a lesson."""
    for cell in source.cells:
        if lines(cell) > MOST_IN_A_CELL and SUBJECT not in cell.tags:
            yield (
                cell,
                f"{lines(cell)} lines of visible code, at most {MOST_IN_A_CELL}: split the cell, "
                f"tag it {FOLDED!r} if readers can skip it, or {SUBJECT!r} if the code is the "
                "subject",
            )
    total = sum(map(lines, source.cells))
    if total > MOST:
        yield source.cells[0], f"{total} lines of visible code in the lesson, at most {MOST}"
