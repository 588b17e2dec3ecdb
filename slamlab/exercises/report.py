"""Report a verdict to a student: laws, points, the smallest failing case, hint."""

import os
import sys
import textwrap

from slamlab.exercises.drives.input_sets import MAIN
from slamlab.exercises.task import Task
from slamlab.exercises.verdict import Verdict

WIDTH = 96  # of what is said [letters]
KEPT, BROKEN, WAITS = "✓", "✗", "–"
"""Marks of laws: it holds; it is broken; another is broken without which it cannot hold."""
_COLOURS = {KEPT: "\x1b[32m", BROKEN: "\x1b[31m"}
_PLAIN = "\x1b[0m"


def number(points):
    """Format a number of points without idle decimals: 2, 1.5."""
    return f"{points:g}"


def points(value):
    """Format points with their unit: "1 point", "2 points"."""
    return f"{number(value)} point{'' if value == 1 else 's'}"


def format_verdict(task: Task, verdict: Verdict) -> str:
    """Format a verdict: law by law, with the case that fails and the hint of the mistake.

    Parameters
    ----------
    task : Task
    verdict : Verdict of that task

    Returns
    -------
    str, some lines
    """
    mark = KEPT if verdict.full else BROKEN
    earned = f"{number(verdict.points)} of {points(verdict.max_points)}"
    lines = [f"{mark} {task.id} · {task.title}: {earned}"]
    if verdict.problem:
        lines.append(f"  {verdict.problem}")
    lines += [f"  {format_law(law, mark, task)}" for law, mark in marked_laws(verdict, task)]
    problems = dict.fromkeys(p for law in verdict.laws for p in law.where.values() if p)
    lines += [f"  {problem}" for problem in problems]
    # JupyterLab breaks longer lines in the middle of a word
    lines = [_filled(line) for line in lines]
    if verdict.case:
        lines.append(verdict.case)
    if verdict.hint:
        hint = textwrap.fill(verdict.hint, WIDTH - 10)
        lines.append(textwrap.indent(hint, " " * 10).replace(" " * 10, "    Hint: ", 1))
    return "\n".join(lines)


def _filled(line):
    """A line wrapped, but not between a number and its points."""
    kept = line.replace(" point", "\N{NO-BREAK SPACE}point")
    filled = textwrap.fill(kept, WIDTH, subsequent_indent="    ")
    return filled.replace("\N{NO-BREAK SPACE}", " ")


def marked_laws(verdict: Verdict, task: Task | None):
    """The results of a verdict's laws, each with its mark.

    Parameters
    ----------
    verdict : Verdict
    task : Task or None, of that verdict, which tells what builds on what; None where it is gone

    Returns
    -------
    list of (LawResult, str): KEPT, BROKEN, or WAITS where a law is broken without which it cannot
        hold
    """
    broken = {law.name for law in verdict.laws if law.failed}
    laws = task.all_laws if task else ()
    waiting = {law.name for law in laws if broken.intersection(law.after)}
    return [
        (law, KEPT if not law.failed else WAITS if law.name in waiting else BROKEN)
        for law in verdict.laws
    ]


def reason(law, mark):
    """What there is to say of a law beside its points: "" or a clause."""
    if mark == WAITS:
        return "builds on a law that is broken"
    if mark == KEPT and law.points < law.max_points:
        return "by itself it earns nothing"
    return ""


def format_law(law, mark, task) -> str:
    """Format the result of one law: what it asks, whether it holds, which inputs broke it.

    Parameters
    ----------
    law : LawResult
    mark : str, of :func:`marked_laws`
    task : Task or None, of that law
    """
    if mark == KEPT and law.points == law.max_points:
        return f"{KEPT} {law.says} ({points(law.points)})"
    why, lost = reason(law, mark), f"0 of {points(law.max_points)}"
    if mark == KEPT:
        return f"{mark} {law.says} ({lost}: {why})"
    why = why or broken_by(law, task)
    return f"{mark} {law.says}{f': {why}' if why else ''} ({lost})"


def coloured(text, wanted=None) -> str:
    """Colour the marks ✓ and ✗ of a text by ANSI's codes, where these are shown in colours.

    Parameters
    ----------
    text : str
    wanted : bool or None; None: in a notebook and on a terminal, but where NO_COLOR is set
    """
    if wanted is None:
        wanted = not os.environ.get("NO_COLOR") and (_in_notebook() or sys.stdout.isatty())
    for mark, colour in _COLOURS.items() if wanted else ():
        text = text.replace(mark, f"{colour}{mark}{_PLAIN}")
    return text


def broken_by(law, task) -> str:
    """Which inputs broke a law, in words; "" where it speaks of all of them together.

    Parameters
    ----------
    law : LawResult
    task : Task or None, of that law
    """
    if MAIN in law.where:
        as_a_whole = law.tried <= (task.sets_judged(law.name) if task else 1)
        return "" if as_a_whole else f"broken by {law.failed} of {law.tried} inputs"
    return f"broken with {and_others(list(law.where))}" if law.where else ""


def and_others(probes) -> str:
    """Name the first of some probes, and how many others there are: "an empty map and 1 other"."""
    count = len(probes) - 1
    kinds = "1 other kind of input" if count == 1 else f"{count} other kinds of input"
    return f"{probes[0]} and {kinds}" if count else probes[0]


def _in_notebook():
    # the kernel's own shell, without importing it
    shell = sys.modules.get("ipykernel.zmqshell")
    return shell is not None and shell.ZMQInteractiveShell.initialized()
