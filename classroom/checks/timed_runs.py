"""Run a task in a notebook within its time limit, with captured output and warnings."""

import warnings
from difflib import get_close_matches

from classroom.exercises import time_limit
from classroom.exercises.failing_case_text import wrapped
from classroom.exercises.function_calls import line_in_cell
from classroom.exercises.run_task import run, run_and_explain
from classroom.exercises.task import OPEN_SEED

WARNINGS = 3  # most warnings of Python that a check prints


def run_task(task, namespace, references, explain):
    """Judge a task within its time limit; return the verdict, printed text, and warnings.

    explain : whether the mistake and the smallest failing case are added"""
    if not time_limit.can_limit_time():
        print("No time limit can be set here. If the check does not end, interrupt the kernel.")
    with time_limit.capture_output() as printed, warnings.catch_warnings(record=True) as caught:
        try:
            with time_limit.time_limit(task.call.seconds):
                if explain:
                    verdict = run_and_explain(task, namespace, references)
                else:
                    verdict = run(task, namespace, task.draw_inputs(OPEN_SEED), references)
            if verdict.kind == "missing" and verdict.problem.endswith("is not defined"):
                near = get_close_matches(verdict.problem.split()[0], namespace, n=1, cutoff=0.8)
                meant = f", or did you mean {near[0]}?" if near else ""
                problem = f"{verdict.problem} yet: run the cell above{meant}"
                verdict = task.failed("missing", problem)
        except time_limit.TimeLimitExceeded:
            verdict = task.failed("time", too_slow(task))
        except KeyboardInterrupt:
            verdict = task.failed("stopped", "stopped before the check was finished")
    return verdict, printed.text, _format_warnings(caught)


def too_slow(task):
    return f"still running after {task.call.seconds:g} s: is there an infinite loop or a slow step?"


def _format_warnings(caught):
    """Format Python's warnings, each once."""
    texts = dict.fromkeys(
        f"{each.category.__name__}: {each.message}{line_in_cell(each.filename, each.lineno)}"
        for each in caught
    )
    lines = [wrapped(f"Python warned: {text}") for text in list(texts)[:WARNINGS]]
    if len(texts) > WARNINGS:
        lines.append(f"… and {len(texts) - WARNINGS} more")
    return "\n".join(lines)
