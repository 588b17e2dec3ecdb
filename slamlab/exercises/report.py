"""Report a verdict to a student in plain text: laws, points, hint."""

import textwrap

from slamlab.exercises.task import Task
from slamlab.exercises.verdict import Verdict

WIDTH = 96  # of what is said [letters]


def number(points):
    """Format a number of points without idle decimals: 2, 1.5."""
    return f"{points:g}"


def points(value):
    """Format points with their unit: "1 point", "2 points"."""
    return f"{number(value)} point{'' if value == 1 else 's'}"


def format_verdict(task: Task, verdict: Verdict) -> str:
    """Format a verdict: law by law, with the hint of the diagnosis (misconception).

    Parameters
    ----------
    task : Task
    verdict : Verdict of that task

    Returns
    -------
    str, some lines
    """
    mark = "✓" if verdict.full else "✗"
    earned = f"{number(verdict.points)} of {points(verdict.max_points)}"
    lines = [f"{mark} {task.id} · {task.title}: {earned}"]
    if verdict.problem:
        lines.append(f"  {verdict.problem}")
    lines += [f"  {format_law(law)}" for law in verdict.laws]
    if verdict.hint:
        lines.append(f"  Hint: {verdict.hint}")
    # JupyterLab breaks longer lines in the middle of a word
    return "\n".join(textwrap.fill(line, WIDTH, subsequent_indent="    ") for line in lines)


def format_law(law) -> str:
    """Format the result of one law: what it asks, whether it holds, how many inputs broke it."""
    if not law.failed:
        return f"✓ {law.says} ({points(law.points)})"
    broken = f": broken by {law.failed} of {law.tried} inputs" if law.tried > 1 else ""
    return f"✗ {law.says}{broken} (0 of {points(law.max_points)})"
