"""Text of a verdict for a student: laws, points, failing case, hint."""

import os
import sys
import textwrap

from classroom.exercises.function_calls.run_and_pack import MAIN
from classroom.exercises.task import Task
from classroom.exercises.verdict import Verdict

WIDTH = 96  # of the text [characters]
KEPT, BROKEN, WAITS = "✓", "✗", "–"
"""Marks of a law that holds, of a law that is broken, and of a law that depends on a broken law."""
_COLOURS = {KEPT: "\x1b[32m", BROKEN: "\x1b[31m"}
_PLAIN = "\x1b[0m"


def number(points):
    """Format a number of points without trailing zeros: 2, 1.5."""
    return f"{points:g}"


def points(value):
    """Format points with the unit: "1 point", "2 points"."""
    return f"{number(value)} point{'' if value == 1 else 's'}"


def format_verdict(task: Task, verdict: Verdict, at_once=False) -> str:
    """Format a verdict: law by law, with the failing case.

    at_once : whether the hint is shown, too"""
    mark = KEPT if verdict.full else BROKEN
    earned = f"{number(verdict.points)} of {points(verdict.max_points)}"
    lines = [f"{mark} {task.id} · {task.title}: {earned}"]
    lines += [f"  {text}" for text in (verdict.carried, verdict.problem) if text]
    lines += [f"  {format_law(law, mark, task)}" for law, mark in marked_laws(verdict, task)]
    problems = dict.fromkeys(p for law in verdict.laws for p in law.where.values() if p)
    lines += [f"  {problem}" for problem in problems]
    # JupyterLab breaks longer lines inside words
    lines = [_filled(line) for line in lines]
    if verdict.case:
        lines.append(verdict.case)
    if verdict.hint and at_once:
        hint = textwrap.fill(verdict.hint, WIDTH - 10)
        lines.append(textwrap.indent(hint, " " * 10).replace(" " * 10, "    Hint: ", 1))
    return "\n".join(lines)


def _filled(line):
    """Wrap a line, but not between a number and "points"."""
    kept = line.replace(" point", "\N{NO-BREAK SPACE}point")
    filled = textwrap.fill(kept, WIDTH, subsequent_indent="    ")
    return filled.replace("\N{NO-BREAK SPACE}", " ")


def marked_laws(verdict: Verdict, task: Task | None):
    """Return the results of a verdict's laws, each with KEPT, BROKEN or WAITS.

    task : the judged task, whose laws depend on each other; None if the task no longer exists."""
    broken = {law.name for law in verdict.laws if law.failed}
    laws = task.all_laws if task else ()
    waiting = {law.name for law in laws if broken.intersection(law.after)}
    return [
        (law, KEPT if not law.failed else WAITS if law.name in waiting else BROKEN)
        for law in verdict.laws
    ]


def reason(law, mark):
    """Return a clause that states why a law earns no points, or "" if no reason is needed."""
    if mark == WAITS:
        return "depends on a broken law"
    if mark == KEPT and law.points < law.max_points:
        return "counts only together with other laws"
    return ""


def format_law(law, mark, task) -> str:
    """Format a law's result: its statement, whether it holds, which inputs break it."""
    if mark == KEPT and law.points == law.max_points:
        return f"{KEPT} {law.says} ({points(law.points)})"
    why, lost = reason(law, mark), f"0 of {points(law.max_points)}"
    if mark == KEPT:
        return f"{mark} {law.says} ({lost}: {why})"
    why = why or broken_by(law, task)
    return f"{mark} {law.says}{f': {why}' if why else ''} ({lost})"


def coloured(text, wanted=None) -> str:
    """Colour the marks in a text with ANSI escape codes.

    wanted : bool; None colours in a notebook and on a terminal, unless NO_COLOR is set."""
    if wanted is None:
        wanted = not os.environ.get("NO_COLOR") and (_in_notebook() or sys.stdout.isatty())
    for mark, colour in _COLOURS.items() if wanted else ():
        text = text.replace(mark, f"{colour}{mark}{_PLAIN}")
    return text


def broken_by(law, task) -> str:
    """Describe which inputs break a law; "" for a law on all inputs together."""
    if MAIN in law.where:
        as_a_whole = law.tried <= (task.sets_judged(law.name) if task else 1)
        return "" if as_a_whole else f"broken by {law.failed} of {law.tried} inputs"
    return f"broken with {name_probes(list(law.where))}" if law.where else ""


def name_probes(probes) -> str:
    """Name up to three probes, as the end of "with …": "an empty map and with α near π"."""
    if len(probes) > 3:
        return f"{len(probes)} kinds of special inputs, for instance with {probes[0]}"
    *others, last = probes
    return f"{', with '.join(others)} and with {last}" if others else last


def _in_notebook():
    # the kernel's own shell, without importing it
    shell = sys.modules.get("ipykernel.zmqshell")
    return shell is not None and shell.ZMQInteractiveShell.initialized()
