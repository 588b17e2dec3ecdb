"""An exercise solved by the information of a screen reader: roles, names and the keyboard."""

import nbformat
import pytest

from course.source import ROOT

pytestmark = pytest.mark.walk
EXERCISE = "ex03_kalman_filter.ipynb"


def pairs():
    """Of each cell that the student writes: what is handed out, and the solution."""
    handed_out, solved = (
        nbformat.read(ROOT / folder / EXERCISE, as_version=4).cells
        for folder in ("exercises", "solutions")
    )
    return [
        (before.source, after.source)
        for before, after in zip(handed_out, solved, strict=True)
        if before.source != after.source
    ]


def telling_line(source):
    """The line by which the cell is known: that of its first function."""
    return next(line for line in source.splitlines() if line.startswith(("def ", "class ")))


def test_an_exercise_is_solved_through_the_accessibility_tree_alone(visit):
    page = visit.page
    visit.open(f"exercises/{EXERCISE}")
    page.get_by_role("menuitem", name="Run", exact=True).click()
    page.get_by_role("menuitem", name="Run All Cells", exact=True).click()
    editors = page.get_by_role("textbox", name="code", exact=True)
    for before, after in pairs():
        editor = editors.filter(has_text=telling_line(before))
        editor.focus()
        page.keyboard.press("Control+a")
        page.keyboard.insert_text(after)
        page.keyboard.press("Shift+Enter")  # the next cell, the check, is selected
        page.keyboard.press("Shift+Enter")
    articles = page.get_by_role("article")
    tasks = [line for line in page.get_by_role("heading").all_text_contents() if "points" in line]
    assert len(tasks) == len(pairs())
    checks = articles.filter(has=editors.filter(has_text="check("))
    for task in tasks:
        points = task.split("·")[2].split()[0]
        reported = checks.get_by_text(f"{points} of {points} points")
        reported.first.wait_for(state="attached")
    received = "\n".join(checks.nth(k).aria_snapshot() for k in range(checks.count()))
    assert received.count("✓") >= len(tasks)
    assert "not attempted" not in received
